// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/cast/review.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// The folder `edited` in the output folder, made if need be.
/// \throws CannotCreate, also if it is a link that leads out of the output folder.
std::filesystem::path make_edited_folder(const Config& config);

/// Lines of a review, by the face's id.
using MarkLines = std::map<std::string, std::string>;

/// What an editor leaves behind. Every file is whole or not there, whenever the editor is killed. Any thread may ask.
class EditedFolder {
 public:
  /// The formats in which it saves meshes, by their files' endings: "obj".
  static std::vector<std::string> formats();

  /// \param job    must outlive this object
  /// \param path   see make_edited_folder
  /// \param marks  what this editor has said about faces before it opened the job again
  EditedFolder(const Job& job, std::filesystem::path path, MarkLines marks);

  const std::filesystem::path& path() const { return path_; }

  /// What the page last kept, as it gave it; empty: nothing yet.
  std::string state() const;
  void keep_state(std::string_view text);

  /// Writes the mesh, then its recipe among those of edited.jsonl, in place of one with the same id:
  /// `crowdface blend` makes the same file from that line.
  /// \param textures   blends those of the face's own, or null
  /// \return the file
  std::filesystem::path save(const CastFace& face, MeshFormat format, const Positions& positions,
                             const FaceTextures& textures);
  void save_picture(const std::string& name, std::string_view png);
  /// Writes the mark among those of review.yaml that this editor made, in place of one about the same
  /// face. \throws Error if a config would refuse it.
  std::filesystem::path save_mark(const ReviewMark& mark);
  MarkLines marks();

 private:
  const Job& job_;
  std::filesystem::path path_;
  std::mutex mutex_;
  MarkLines marks_;
};

}  // namespace crowdface
