// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/cast/review.h"
#include "crowdface/core/folder.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// Returns the folder `edited` in the output folder, and creates the folder if necessary.
/// \throws CannotCreate, also if the folder is a link that leads out of the output folder.
std::filesystem::path make_edited_folder(const Config& config);

/// The files that an editor saves, during the editor's lifetime. Each file is complete or absent,
/// even if the editor is killed. Thread-safe. All members that write throw IoError if another
/// folder has replaced this one.
class EditedFolder {
 public:
  /// The formats for saved meshes, by their file extensions, such as "obj".
  static std::vector<std::string> formats();

  /// \param path  result of make_edited_folder
  explicit EditedFolder(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  /// Call this before other code writes to the folder.
  void require_same() const { handle_.require_same(); }

  /// Returns the text that the page last saved as its state; empty if there is none.
  std::string state() const;
  /// From now on, only this page may replace the state: two pages would overwrite each other's steps.
  void take_over(std::string page);
  /// Saves the state of a page.
  /// \param page  the page that sends the state, or empty if no page has taken over
  /// \return false, without an effect, if another page has taken over
  bool save_state(std::string_view text, const std::string& page);

  /// Writes the mesh of a face in one format.
  using WriteMesh =
      std::function<void(const FacePlan&, MeshFormat, const std::filesystem::path& file)>;
  /// Writes the recipe to edited.jsonl, in place of a recipe with the same id, then the mesh that
  /// `crowdface blend` makes from the recipe. If meshes of this face exist in other formats,
  /// rewrites them, too.
  /// \return the file of the mesh
  std::filesystem::path save(const Job& job, const FacePlan& face, MeshFormat format,
                             const WriteMesh& write);
  /// Writes the meshes that are older than their recipe because a save was interrupted by a crash
  /// or a disk error.
  void finish_saves(const Job& job, const WriteMesh& write);
  /// Writes a mark or a change to review.yaml, in place of the mark or change of the same face; an
  /// empty change removes it. If the crowd already has the review in this file, begins a new
  /// review, so that no mark applies twice.
  /// \throws Error if a config would reject the existing review or the result.
  std::filesystem::path save_mark(const Config& config, const ReviewMark& mark);
  std::filesystem::path save_change(const Config& config, const FaceChange& change);

 private:
  void write_meshes(const FacePlan& face, const std::string& ending, const WriteMesh& write) const;
  std::filesystem::path save_review(const Config& config, const std::function<void(Review&)>& edit);

  std::filesystem::path path_;
  DirectoryHandle handle_;
  std::mutex mutex_;
  std::string editing_page_;  ///< see take_over
};

}  // namespace crowdface
