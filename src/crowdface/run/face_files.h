// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/core/file.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/io/mesh_format.h"
#include "crowdface/validity/skin_check.h"

namespace crowdface {

/// Which of a face's mesh files: the face, or what it has of its shapes, on a level of detail, or something
/// that it wears.
struct MeshName {
  MeshFormat format = MeshFormat::kObj;
  std::string shape = {};       ///< of one shape; kAllShapes; kFollowingPoints; empty: at rest
  std::size_t level = 0;        ///< of detail; 0: the whole mesh
  std::string attachment = {};  ///< empty: the face
};
/// The displacements of all shapes.
inline constexpr const char* kAllShapes = "shapes";
/// What stands after the face's id in the file's name: "LOD1+smile", "bob+smile", or nothing.
std::string part_of(const MeshName& name);
/// The whole of it: "+LOD1+smile.obj".
std::string file_end(const MeshName& name);
std::filesystem::path mesh_path(const CrowdDirectory& directory, const std::string& id,
                                const MeshName& name);

/// A face's file as it was written.
struct MeshFile {
  MeshName name;
  FileDigest content;
};

/// What one face's files are.
struct FaceFiles {
  std::vector<MeshFile> meshes;
  std::vector<FileDigest> own;        ///< textures and materials of its own, see own_file_names
  std::optional<FileDigest> picture;  ///< if it was rendered
  std::optional<FileDigest> preview;  ///< its mesh in the gallery, if there is one
  std::optional<SkinDefects> skin;    ///< against the target's, if it was judged
  std::vector<Index> crossing;  ///< see FaceShapes::of_face; of no shapes if none were carried
};

}  // namespace crowdface
