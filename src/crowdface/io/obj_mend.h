// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// An OBJ text that other programs read, as the strict scan wants it.
struct MendedObj {
  std::string text;
  std::vector<std::string> notes;  ///< what the text lost, a sentence each
};

/// Rewrites what exporters get wrong without harm to the mesh: a byte-order mark, lone CRs, NULs at the end, continued
/// lines, comments behind statements, normals and texture coordinates that are missing or no numbers, colours that are
/// no numbers, faces of fewer than three corners. Lines keep their numbers. Positions and faces are never guessed.
/// \return nothing if there is nothing of the kind.
std::optional<MendedObj> mend_obj(std::string_view text);

}  // namespace crowdface
