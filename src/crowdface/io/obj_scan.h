// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Where in a file a run of numbers stands: from the first character of the first to the end of the
/// last.
struct TextSpan {
  std::uint64_t begin = 0;
  std::uint32_t length = 0;
};

/// From which face on a material is in use.
struct MaterialRange {
  std::string name;
  Index first_face = 0;
};

/// What the strict scan of an OBJ text finds: all numbers, and where they stand.
struct ObjScan {
  Positions positions;                 ///< #V by 3
  TextureCoordinates uvs;              ///< #T by 2
  std::vector<TextSpan> vertex_spans;  ///< #V, the x y z of each `v`
  std::vector<TextSpan> normal_spans;  ///< #N, the x y z of each `vn`
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
