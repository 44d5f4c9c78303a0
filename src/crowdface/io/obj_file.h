// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/core/file.h"
#include "crowdface/io/obj_scan.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A parsed OBJ file: its mesh, and its text, which stays mapped so that it can be written again
/// with other positions and no other change.
struct ObjFile {
  std::filesystem::path path;
  MappedFile file;
  Topology topology;       ///< quads and n-gons kept, vertex order kept
  Positions positions;     ///< #V by 3, in file units
  TextureCoordinates uvs;  ///< #T by 2
  /// #C indices of `vn`, or kNoIndex; empty if the file has no `vn`.
  std::vector<std::uint32_t> corner_normals;
  std::vector<std::string> material_libraries;
  std::vector<MaterialRange> materials;
  std::vector<MaterialRange> groups;
  std::vector<std::string> notes;  ///< repairs and ignored statements, one sentence each
  bool is_mended = false;          ///< whether repairs changed the text
  /// Path of any file in the folder that holds the material files; empty if that is the folder of
  /// `path`.
  std::filesystem::path textures_at;

  const std::filesystem::path& material_path() const {
    return textures_at.empty() ? path : textures_at;
  }
};

/// Reads an OBJ file with tinyobjloader after a strict check of the text (see `scan_obj`). Repairs
/// a text that fails the check (see `mend_obj`).
/// \throws MissingInput, or InvalidInput naming file, line, what was expected and what was found.
ObjFile read_obj(const std::filesystem::path& path);
/// Reads an OBJ file whose content is mapped.
/// \param file  content of the file at `path`.
/// \param outline  outline of this content.
ObjFile read_obj(const std::filesystem::path& path, MappedFile file, const ObjOutline& outline);

/// Reads an OBJ file whose polygons and texture coordinates equal those of an earlier file. The
/// result's topology, texture coordinates and corner normals stay empty.
/// \param outline  outline of the file, with the same `mesh` hash as the earlier file.
ObjFile read_obj_of_same_mesh(const std::filesystem::path& path, MappedFile file,
                              const ObjOutline& outline);

/// The material of each polygon.
struct FaceMaterials {
  std::vector<std::string>
      names;  ///< unique, in order of first use by a face; empty where a face has no material
  std::vector<std::uint32_t> material_of_face;  ///< #F indices into `names`
};

/// Returns the material of each polygon.
/// \param ranges  materials of an OBJ file.
FaceMaterials face_materials(const std::vector<MaterialRange>& ranges, Index face_count);

}  // namespace crowdface
