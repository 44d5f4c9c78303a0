// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>

#include "crowdface/core/units.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A name as USD allows it for a prim: letters, digits and '_', no digit first.
std::string usda_name(std::string_view text);

/// Such names, each given once: later ones get a number.
class UsdaNames {
 public:
  std::string add(std::string_view text);

 private:
  std::set<std::string> known_;
};

/// "[1, 2, 3]".
std::string usda_list(std::span<const std::uint32_t> numbers);
std::string usda_list(std::span<const std::string> items);
/// `"text"`, with what must be escaped.
std::string usda_string(std::string_view text);

/// Vectors as USD writes them, "(1,2,3),(4,5,6)", without brackets around: each number the shortest that
/// reads back as the same single-precision value. A row takes at most kLongestUsdaRow characters.
inline constexpr std::size_t kLongestUsdaRow = 50;
std::string usda_rows(const Positions& rows);

/// "[(0.5,1),(0,0.25)]". \param uvs  #T by 2
std::string usda_uvs(const TextureCoordinates& uvs);

/// The layer's metadata that say which unit and axis up all else is in; the axis is Y for heads whose is
/// neither Y nor Z.
std::string usda_frame(LengthUnit unit, Axis up);

}  // namespace crowdface
