// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

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
};

/// Checks an OBJ text line by line, because the loader accepts what it should not: words where
/// numbers belong, numbers that overflow, indices that point nowhere or wrap, polygons of more than
/// 255 corners, a byte-order mark, binary data. Quads, larger polygons, relative indices, `w` and
/// vertex colours are fine.
/// \param name  the file's name, for messages.
/// \throws InvalidInput naming file, line, what was expected and what was found.
ObjScan scan_obj(std::string_view text, const std::string& name);

}  // namespace crowdface
