// SPDX-License-Identifier: Apache-2.0
// Lists the files of a face. Building, resuming, `sheet`, `blend` and the report use these lists.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/config/config.h"
#include "crowdface/core/file.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/io/encoded_file.h"
#include "crowdface/validity/skin_check.h"

namespace crowdface {

struct FinishedFace;

/// A file of a face. To add a new kind of file, add it to the functions below that return lists of
/// files.
struct FaceFile {
  std::filesystem::path path;
  /// Where report.json stores the file's hash: under `report_key` in the section `report_section`
  /// of the face, such as "LOD1.obj" in "lods". Empty section: directly in the entry of the face,
  /// such as under the key "mesh". Empty key: the report omits the hash.
  std::string report_section, report_key;
  /// Encodes the file. The result refers to the face and to the face's encoders.
  std::function<EncodedFile(const FinishedFace& face)> make;
};

/// Which mesh files a face has.
struct MeshFileOptions {
  const std::vector<MeshFormat>& formats;  ///< formats of the mesh files
  std::filesystem::path folder;            ///< folder of the meshes
  std::string stem;                        ///< first part of the file names, such as the face's id
  /// Whether the list contains, in addition to the whole mesh at rest, the files for levels of
  /// detail, blend shapes, named points and the body's texture. If false, it contains none of these
  /// files.
  bool includes_all_variants = true;
};
/// Lists the mesh files of a face, and the files of the face's attachments, textures and material.
std::vector<FaceFile> mesh_files(const Config& config, const Inputs& inputs, const FacePlan& face,
                                 const MeshFileOptions& options);

/// Encodes files of a face and writes all of these files in one batch.
void write_files_of(const FinishedFace& face, const std::vector<FaceFile>& files);

/// Makes the file lists of a crowd's faces.
class FaceFileLists {
 public:
  /// The arguments must outlive this object.
  FaceFileLists(const Config& config, const Inputs& inputs, const CrowdDirectory& directory);

  /// Lists all files of a face.
  std::vector<FaceFile> all_files(const FacePlan& face) const;
  /// Lists the files that `crowdface sheet` can make again: the face's image, and the face's mesh
  /// in the gallery.
  std::vector<FaceFile> shown_files(const FacePlan& face) const;
  /// Creates the folders for the files of these faces.
  void make_folders(std::span<const FacePlan* const> faces) const;
  const CrowdDirectory& directory() const { return directory_; }

 private:
  const Config& config_;
  const Inputs& inputs_;
  const CrowdDirectory& directory_;
  bool has_gallery_;  ///< whether the crowd has a gallery, with a small mesh of each face
};

/// The results for a face whose files have been written.
struct FaceResult {
  std::vector<FileDigest> file_digests;  ///< one per file of FaceFileLists::all_files
  /// defects that the face's skin has in comparison with the target head; empty if not checked
  std::optional<SkinDefects> skin_defects;
  /// for each blend shape: number of skin triangles that intersect each other in this shape of the
  /// face, see FaceShapes::shapes_of_face; empty if there are no blend shapes
  std::vector<Index> skin_intersections;
};

}  // namespace crowdface
