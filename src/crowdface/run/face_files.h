// SPDX-License-Identifier: Apache-2.0
// The files of a face: one list, which building, resuming, `sheet`, `blend` and the report walk.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/config/config.h"
#include "crowdface/core/file.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/io/encoded_file.h"
#include "crowdface/validity/skin_check.h"

namespace crowdface {

struct FinishedFace;

/// A file of a face. A new kind of file is one more entry of the lists below.
struct FaceFile {
  std::filesystem::path path;
  /// Where the face has the file's hash in report.json: "lods" and "LOD1.obj", or no section and "mesh"; no key:
  /// nowhere.
  std::string section, key;
  /// What the file holds; the result refers to the face and to its encoders.
  std::function<EncodedFile(const FinishedFace& face)> make;
};

/// Which files of meshes a face has.
struct MeshFileOptions {
  const std::vector<MeshFormat>& formats;
  std::filesystem::path folder;  ///< where the meshes lie
  std::string stem;              ///< what their names begin with
  bool all = true;  ///< not only the whole mesh at rest: levels of detail, shapes and points
};
/// All mesh files of a face, with the files of its attachments, its textures and its material.
std::vector<FaceFile> mesh_files(const Config& config, const Inputs& inputs, const CastFace& face,
                                 const MeshFileOptions& options);

/// Makes all of these and writes them together.
void write_files_of(const FinishedFace& face, const std::vector<FaceFile>& files);

/// The lists of a crowd's faces.
class FaceFileLists {
 public:
  /// All must outlive this object.
  FaceFileLists(const Config& config, const Inputs& inputs, const CrowdDirectory& directory);

  /// All files of a face.
  std::vector<FaceFile> of(const CastFace& face) const;
  /// Only those that show the face: its picture and its mesh in the gallery, which `sheet` can make anew.
  std::vector<FaceFile> shown(const CastFace& face) const;
  /// Makes the folders that the files of these faces go to.
  void make_folders(std::span<const CastFace* const> faces) const;
  const CrowdDirectory& directory() const { return directory_; }

 private:
  const Config& config_;
  const Inputs& inputs_;
  const CrowdDirectory& directory_;
  bool has_gallery_;
};

/// What is known of a face whose files are there.
struct FaceResult {
  std::vector<FileDigest> files;    ///< one for each of face_files
  std::optional<SkinDefects> skin;  ///< against the target's, if the mesh was judged
  std::vector<Index> crossing;      ///< see FaceShapes::of_face; none if no shapes were carried
};

}  // namespace crowdface
