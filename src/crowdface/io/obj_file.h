// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/core/file.h"
#include "crowdface/io/obj_scan.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A parsed OBJ file: its mesh and its text. The text stays mapped, so that the program can write
/// it again with other positions and no other change.
struct ObjFile {
  std::filesystem::path path;
  MappedFile file;         ///< content of the file; if `is_mended`, the repaired text
  Topology topology;       ///< not triangulated; polygons and corners in the order of the file
  Positions positions;     ///< #V by 3, in file units
  TextureCoordinates uvs;  ///< #T by 2
  /// For each corner, the index of its `vn` line, or kNoIndex. Empty if the file has no `vn` lines.
  std::vector<std::uint32_t> corner_normals;
  std::vector<std::string> material_libraries;  ///< arguments of the `mtllib` lines
  /// Ranges of polygons with the same material, in ascending order of first_face.
  std::vector<MaterialRange> materials;
  /// Ranges of polygons in the same group or object, in ascending order of first_face.
  std::vector<MaterialRange> groups;
  std::vector<std::string> notes;   ///< repairs and ignored statements, one sentence each
  bool is_mended = false;           ///< whether `mend_obj` changed the text
  bool has_reversed_faces = false;  ///< whether `with_outward_faces` reversed the polygons
  /// A path whose folder contains the material files; the path's file name is ignored. Empty if the
  /// material files are in the folder of `path`.
  std::filesystem::path material_base;

  /// A path whose folder contains the material files: `material_base` or, if it is empty, `path`.
  const std::filesystem::path& material_path() const {
    return material_base.empty() ? path : material_base;
  }
};

/// Reads an OBJ file with tinyobjloader after a strict check of the text (see `scan_obj`). If the
/// text fails the check, repairs it (see `mend_obj`).
/// \throws MissingInput, or InvalidInput with a message that names the file, the line, the expected
/// text and the text found.
ObjFile read_obj(const std::filesystem::path& path);
/// Reads an OBJ file whose content is mapped.
/// \param file  content of the file at `path`.
/// \param summary  summary of this content.
ObjFile read_obj(const std::filesystem::path& path, MappedFile file, const ObjSummary& summary);

/// Reads an OBJ file whose polygons and texture coordinates equal those of an earlier file. The
/// result's topology, texture coordinates and corner normals stay empty, unless the text needs
/// repairs; then the result is that of `read_obj`.
/// \param summary  summary of this file; its `mesh_digest` must equal that of the earlier file.
ObjFile read_obj_of_known_mesh(const std::filesystem::path& path, MappedFile file,
                               const ObjSummary& summary);

/// The materials of a mesh, and the material of each polygon ("face").
struct PolygonMaterials {
  /// unique names, in order of their first use by a polygon; the name "" stands for no material
  std::vector<std::string> names;
  std::vector<std::uint32_t> material_of_polygon;  ///< for each polygon, an index into `names`
};

/// Returns the material of each polygon.
/// \param ranges  the ranges of polygons with equal material, as an OBJ file lists them.
PolygonMaterials polygon_materials(const std::vector<MaterialRange>& ranges, Index face_count);

}  // namespace crowdface
