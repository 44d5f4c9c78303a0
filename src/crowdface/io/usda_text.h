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

/// Makes valid prim names unique by adding numbers to repeated names.
class UsdaNames {
 public:
  /// Returns a unique prim name for a text.
  std::string add(std::string_view text);

 private:
  std::set<std::string> used_names_;
};

/// Formats a list: "[1, 2, 3]".
std::string usda_list(std::span<const std::uint32_t> numbers);
std::string usda_list(std::span<const std::string> items);
/// The text in double quotes, with special characters escaped.
std::string usda_string(std::string_view text);

/// Formats rows as USD vectors, "(1,2,3),(4,5,6)", without enclosing brackets. Each number is the
/// shortest text that reads back as the same single-precision value. A row has at most
/// kMaxUsdaRowLength characters.
inline constexpr std::size_t kMaxUsdaRowLength = 50;
std::string usda_rows(const Positions& rows);

/// Formats texture coordinates: "[(0.5,1),(0,0.25)]".
/// \param uvs  #T by 2
std::string usda_uvs(const TextureCoordinates& uvs);

/// The metadata lines of a layer with unit and up axis. If `up` is neither the Y nor the Z axis,
/// the layer's up axis is Y.
std::string usda_layer_metadata(LengthUnit unit, Axis up);

}  // namespace crowdface
