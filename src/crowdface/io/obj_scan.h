// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/core/hash.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// From which face on a material is in use.
struct MaterialRange {
  std::string name;
  Index first_face = 0;
};

/// What the strict scan of an OBJ text finds.
struct ObjScan {
  Positions positions;     ///< #V by 3
  TextureCoordinates uvs;  ///< #T by 2
  Index face_count = 0;
  Index corner_count = 0;
  std::vector<std::string> material_libraries;
  std::vector<MaterialRange> materials;  ///< ascending first_face; empty if none is used
  std::vector<MaterialRange> groups;     ///< the same of groups and objects (`g`, `o`)
  std::vector<std::string> notes;        ///< what was passed over, a sentence each
};

/// What a first look at an OBJ text finds.
struct ObjOutline {
  std::uint64_t vertices = 0, uvs = 0, normals = 0, faces = 0;
  /// Of all but the numbers of `v` and `vn`, comments and the names of groups, objects and materials: texts that
  /// have it in common have the same faces and texture coordinates, line by line.
  Digest mesh;
};
ObjOutline outline_obj(std::string_view text);

/// Which lines of a text are looked at.
enum class ObjLines {
  kAll,
  kAllButMesh,  ///< not `f` and `vt`, which are those of a text that was scanned before
};

/// Checks an OBJ text line by line, because the loader accepts what it should not: words where
/// numbers belong, numbers that overflow, indices that point nowhere or wrap, polygons of more than
/// 255 corners, a byte-order mark, binary data. Quads, larger polygons, relative indices, `w` and
/// vertex colours are fine; statements of other programs are passed over.
/// \param name  the file's name, for messages.
/// \throws InvalidInput naming file, line, what was expected and what was found.
/// \param outline  of the text
/// \param lines    without those of the mesh the result has no texture coordinates and no corners.
ObjScan scan_obj(std::string_view text, const std::string& name, const ObjOutline& outline,
                 ObjLines lines);

}  // namespace crowdface
