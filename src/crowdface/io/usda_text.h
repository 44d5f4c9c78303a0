// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>

#include "crowdface/core/units.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Changes a text into a valid USD prim name, which has only letters, digits and '_' and does not
/// begin with a digit.
std::string usda_name(std::string_view text);

/// Makes unique prim names: adds a number to a name that was used before.
class UsdaNames {
 public:
  /// Returns a valid prim name for a text, different from all names returned before.
  std::string add(std::string_view text);

 private:
  std::set<std::string> used_names_;  ///< all names returned so far
};

/// Formats a list of numbers: "[1,2,3]".
std::string usda_list(std::span<const std::uint32_t> numbers);
/// Formats a list of items that are already USD text: "[a, b]".
std::string usda_list(std::span<const std::string> items);
/// The text in double quotes, with special characters escaped.
std::string usda_string(std::string_view text);

/// Maximum number of characters of a row in the result of `usda_rows`.
inline constexpr std::size_t kMaxUsdaRowLength = 50;
/// Formats rows as USD vectors, "(1,2,3),(4,5,6)", without enclosing brackets. Each number is the
/// shortest text that reads back as the same single-precision value.
std::string usda_rows(const Positions& rows);

/// Formats texture coordinates: "[(0.5,1),(0,0.25)]".
/// \param uvs  #T by 2
std::string usda_uvs(const TextureCoordinates& uvs);

/// The lines at the start of a layer that state its unit and up axis. If `up` is neither the Y nor
/// the Z axis, the layer's up axis is Y.
std::string usda_layer_metadata(LengthUnit unit, Axis up);

}  // namespace crowdface
