// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace crowdface {

/// What one unit of a mesh file is.
enum class LengthUnit { kMillimetre, kCentimetre, kMetre, kInch };

inline constexpr std::array kLengthUnits = {LengthUnit::kMillimetre, LengthUnit::kCentimetre,
                                            LengthUnit::kMetre, LengthUnit::kInch};

double mm_per(LengthUnit unit);
/// "mm", "cm", "m" or "in".
std::string_view name_of(LengthUnit unit);
/// The unit of that name, or nothing.
std::optional<LengthUnit> parse_length_unit(std::string_view name);
/// Of mm, cm and m the unit in which `length` is nearest to `typical_mm`, as a ratio.
LengthUnit nearest_unit(double length, double typical_mm);
/// A length with its unit, such as "8 mm" or "1.5cm", in millimetres; nothing if it is not one.
std::optional<double> parse_length_mm(std::string_view text);

/// A signed coordinate axis, such as +Y.
struct Axis {
  int index = 1;  ///< 0 x, 1 y, 2 z
  int sign = 1;   ///< +1 or −1
  bool operator==(const Axis&) const = default;
};
/// "+X", "-Z", "y"; nothing if it is not an axis.
std::optional<Axis> parse_axis(std::string_view text);
/// "+Y".
std::string name_of(Axis axis);

}  // namespace crowdface
