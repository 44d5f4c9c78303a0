// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace crowdface {

/// What one unit of a mesh file is: a length.
struct LengthUnit {
  double mm = 10;
  bool operator==(const LengthUnit&) const = default;
  static const LengthUnit kMillimetre, kCentimetre, kMetre, kInch;
};
inline constexpr LengthUnit LengthUnit::kMillimetre{1};
inline constexpr LengthUnit LengthUnit::kCentimetre{10};
inline constexpr LengthUnit LengthUnit::kMetre{1000};
inline constexpr LengthUnit LengthUnit::kInch{25.4};

/// Those that have a name.
inline constexpr std::array kLengthUnits = {LengthUnit::kMillimetre, LengthUnit::kCentimetre,
                                            LengthUnit::kMetre, LengthUnit::kInch};

inline double mm_per(LengthUnit unit) {
  return unit.mm;
}
/// "mm", "cm", "m" or "in"; of others a length, "2438.4 mm".
std::string name_of(LengthUnit unit);
/// The unit of that name, or a length with its unit, such as "243.84 cm"; nothing if it is neither.
std::optional<LengthUnit> parse_length_unit(std::string_view text);
/// Of mm, cm and m the unit in which `length` is nearest to `typical_mm`, as a ratio.
LengthUnit nearest_unit(double length, double typical_mm);
/// The unit in which `length` is `typical_mm`, to two digits.
LengthUnit fitting_unit(double length, double typical_mm);
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
