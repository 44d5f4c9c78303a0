// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// A repaired OBJ text.
struct MendedObj {
  std::string text;                ///< the whole text after the repairs
  std::vector<std::string> notes;  ///< the repairs, one sentence each
};

/// Repairs common harmless exporter errors: a byte-order mark, lone CRs, NULs at the end, continued
/// lines, comments after statements, missing or non-numeric normals and texture coordinates,
/// non-numeric colours, polygons with fewer than three corners. Line numbers do not change. The
/// function never invents positions or polygons.
/// \return nothing if the text has no such error.
std::optional<MendedObj> mend_obj(std::string_view text);

}  // namespace crowdface
