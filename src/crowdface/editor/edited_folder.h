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

/// The folder `edited` in the output folder, made if need be.
/// \throws CannotCreate, also if it is a link that leads out of the output folder.
std::filesystem::path make_edited_folder(const Config& config);

/// What an editor leaves behind, for as long as it runs. Every file is whole or not there, whenever the editor is killed.
/// Any thread may ask. Everything that writes throws IoError if another folder has taken this one's place.
class EditedFolder {
 public:
  /// The formats in which it saves meshes, by their files' endings: "obj".
  static std::vector<std::string> formats();

  /// \param path  see make_edited_folder
  explicit EditedFolder(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  /// To be called before something else is written there.
  void require_same() const { held_.require_same(); }

  /// What the page last kept, as it gave it; empty: nothing yet.
  std::string state() const;
  void keep_state(std::string_view text);

  /// Writes the mesh of a face in one format.
  using WriteMesh =
      std::function<void(const CastFace&, MeshFormat, const std::filesystem::path& file)>;
  /// Writes the recipe among those of edited.jsonl, in place of one with the same id, then the mesh that
  /// `crowdface blend` makes of it, also in the other formats in which the face lies there.
  /// \return the file
  std::filesystem::path save(const Job& job, const CastFace& face, MeshFormat format,
                             const WriteMesh& write);
  /// Writes the meshes that a save left older than their recipe, because the editor was killed or the disk failed.
  void finish_saves(const Job& job, const WriteMesh& write);
  void save_picture(const std::string& name, std::string_view png);
  /// Writes the mark among those of review.yaml, in place of one about the same face.
  /// \throws Error if a config would refuse the marks that are there, or this one.
  std::filesystem::path save_mark(const Config& config, const ReviewMark& mark);

 private:
  void write_meshes(const CastFace& face, const std::string& ending, const WriteMesh& write) const;

  std::filesystem::path path_;
  HeldFolder held_;
  std::mutex mutex_;
};

}  // namespace crowdface
