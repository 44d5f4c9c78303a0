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
#include "crowdface/run/job.h"

namespace crowdface {

/// Returns the folder `edited` in the output folder, and creates the folder if necessary.
/// \throws CannotCreate if the folder cannot be created, or is a link that leads out of the output
/// folder.
std::filesystem::path make_edited_folder(const Config& config);

/// The folder `edited`, in which an editor saves files. Each file is complete or absent, even if
/// the editor is killed. Thread-safe. All member functions that write throw IoError if another
/// folder has replaced this folder.
class EditedFolder {
 public:
  /// File extensions, such as "obj", of the formats in which meshes can be saved.
  static std::vector<std::string> formats();

  /// \param path  result of make_edited_folder
  explicit EditedFolder(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  /// Checks that path() still leads to the folder that the constructor opened. Code outside this
  /// class must call this function before it writes to the folder.
  /// \throws IoError if the path leads to another folder.
  void require_same_folder() const { handle_.require_still_at_path(); }

  /// Returns the state text that a page saved last; empty if no page has saved a state.
  std::string saved_state() const;
  /// Makes the browser page with this id the only page that may save the state, so that two open
  /// pages do not overwrite each other's editing steps.
  void set_only_saving_page(std::string page);
  /// Saves the state of a page.
  /// \param page  id of the page that sends the state, or empty if no page has called
  ///              set_only_saving_page
  /// \return false if only another page may save; the state is then not saved
  bool save_state(std::string_view text, const std::string& page);

  /// Writes the mesh of a face in one format.
  using WriteMesh =
      std::function<void(const FacePlan&, MeshFormat, const std::filesystem::path& file)>;
  /// Writes the recipe to edited.jsonl, where it replaces a recipe with the same id. Then writes
  /// the mesh that `crowdface blend` makes from the recipe. If the folder has meshes of this face
  /// in other formats, also rewrites these meshes.
  /// \return the file of the mesh
  std::filesystem::path save(const Job& job, const FacePlan& face, MeshFormat format,
                             const WriteMesh& write);
  /// Completes saves that a crash or a disk error interrupted: writes the meshes of the faces whose
  /// recipes were saved without the meshes.
  void finish_interrupted_saves(const Job& job, const WriteMesh& write);
  /// Writes a mark (save_mark) or a change (save_change) of a face to review.yaml. Replaces the
  /// earlier mark or change of this face. An empty change removes the earlier change. If a run has
  /// already applied this review to the crowd, begins a new review, so that no mark applies twice.
  /// \throws Error if review.yaml is invalid, or would be invalid afterwards.
  std::filesystem::path save_mark(const Config& config, const ReviewMark& mark);
  std::filesystem::path save_change(const Config& config, const FaceChange& change);

 private:
  /// Writes the face's mesh with the extension `ending`, and rewrites the existing meshes of this
  /// face in other formats.
  void write_meshes(const FacePlan& face, const std::string& ending, const WriteMesh& write) const;
  /// Reads review.yaml or begins a new review, applies `edit`, and writes review.yaml.
  std::filesystem::path save_review(const Config& config, const std::function<void(Review&)>& edit);

  std::filesystem::path path_;
  DirectoryHandle handle_;  ///< detects whether another folder has replaced this folder
  std::mutex mutex_;
  /// id of the only page that may save the state; empty if no page has called
  /// `set_only_saving_page`
  std::string editing_page_id_;
};

}  // namespace crowdface
