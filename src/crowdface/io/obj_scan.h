// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/core/hash.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A range of polygons with the same material or group. The range ends where the next range begins.
struct MaterialRange {
  std::string name;      ///< name of the material or group
  Index first_face = 0;  ///< index of the range's first polygon
};

/// Result of the strict check of an OBJ text.
struct ObjScan {
  Positions positions;                          ///< #V by 3
  TextureCoordinates uvs;                       ///< one row for each `vt` line
  Index face_count = 0;                         ///< number of polygons
  Index corner_count = 0;                       ///< number of corners of all polygons
  std::vector<std::string> material_libraries;  ///< arguments of the `mtllib` lines
  /// Ranges of polygons with the same material, in ascending order of first_face; empty if the text
  /// uses no material.
  std::vector<MaterialRange> materials;
  /// Ranges of polygons in the same group (`g`) or object (`o`), in ascending order of first_face.
  std::vector<MaterialRange> groups;
  std::vector<std::string> notes;  ///< ignored statements, one sentence each
};

/// Line counts and a hash of an OBJ text, from a fast first pass over the text.
struct ObjSummary {
  /// Numbers of `v`, `vt`, `vn` and `f` lines.
  std::uint64_t vertex_count = 0, uv_count = 0, normal_count = 0, face_count = 0;
  /// Hash of the whole text except the numbers of `v` and `vn`, comments, and the names of groups,
  /// objects and materials. Texts with the same hash have the same polygons and texture coordinates
  /// on the same lines.
  Digest mesh_digest;
};
/// Counts the lines of an OBJ text and computes its hash, without checking the lines.
ObjSummary summarise_obj(std::string_view text);

/// Which lines `scan_obj` checks.
enum class ObjLineSelection {
  kAll,
  /// All lines except `f` and `vt`. Use this value if a text with an equal `mesh_digest` has been
  /// checked completely, because texts with equal digests have equal `f` and `vt` lines.
  kAllButMesh,
};

/// Checks an OBJ text line by line for errors that the loader accepts: words in place of numbers,
/// numbers that overflow, indices out of range or wrapping around, a byte-order mark, binary data.
/// Polygons of any size, relative indices, `w` and vertex colours are valid; statements of other
/// programs are ignored.
/// \param name  name of the file, for messages.
/// \param summary  summary of the text.
/// \param line_selection  the lines to check; with kAllButMesh the result has no texture
///                        coordinates and no corners.
/// \throws InvalidInput naming file, line, what was expected and what was found.
ObjScan scan_obj(std::string_view text, const std::string& name, const ObjSummary& summary,
                 ObjLineSelection line_selection);

}  // namespace crowdface
