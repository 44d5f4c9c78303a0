// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace crowdface {

/// The length of one unit of a mesh file.
struct LengthUnit {
  double mm = 10;
  bool operator==(const LengthUnit&) const = default;
  /// the units that have a name
  static const LengthUnit kMillimetre, kCentimetre, kMetre, kInch, kFoot;
};
inline constexpr LengthUnit LengthUnit::kMillimetre{1};
inline constexpr LengthUnit LengthUnit::kCentimetre{10};
inline constexpr LengthUnit LengthUnit::kMetre{1000};
inline constexpr LengthUnit LengthUnit::kInch{25.4};
inline constexpr LengthUnit LengthUnit::kFoot{304.8};

/// All units that have a name.
inline constexpr std::array kLengthUnits = {LengthUnit::kMillimetre, LengthUnit::kCentimetre,
                                            LengthUnit::kMetre, LengthUnit::kInch,
                                            LengthUnit::kFoot};
/// mm, cm and m, the units that most programs export.
inline constexpr std::span kMetricUnits(kLengthUnits.data(), 3);
/// What a user may write for a unit, for messages.
inline constexpr std::string_view kUnitChoices = "mm, cm, m, in, ft, or a length such as 243.84 cm";

/// Millimetres in one unit.
inline double mm_per(LengthUnit unit) {
  return unit.mm;
}
/// The name of a unit: "mm", "cm", "m", "in" or "ft". For a unit without a name, its length, such
/// as "2438.4 mm".
std::string name_of(LengthUnit unit);
/// Parses the name of a unit or a length with a unit, such as "243.84 cm"; nothing if the text is
/// neither of these, or if the length is outside 1e-6 mm … 1e9 mm.
std::optional<LengthUnit> parse_length_unit(std::string_view text);
/// The unit among `units` for which `length` units are closest to `typical_mm` (ratio closest to
/// 1).
LengthUnit nearest_unit(double length, double typical_mm, std::span<const LengthUnit> units);
/// Returns a unit such that a length of `length` units is about `typical_mm` millimetres. Rounds
/// the unit to two significant digits. If the unit differs from Poser's unit (243.84 cm) by at most
/// 10 %, returns Poser's unit.
LengthUnit fitting_unit(double length, double typical_mm);
/// Parses a length with its unit, such as "8 mm" or "1.5cm". Returns millimetres; nothing if the
/// text is not a length.
std::optional<double> parse_length_mm(std::string_view text);

/// A signed coordinate axis, such as +Y.
struct Axis {
  int index = 1;  ///< number of the axis: 0 for x, 1 for y, 2 for z
  int sign = 1;   ///< direction along the axis: +1 or −1
  bool operator==(const Axis&) const = default;
};
/// Parses "+X", "-Z" or "y"; nothing if the text is not an axis.
std::optional<Axis> parse_axis(std::string_view text);
/// The name of an axis: its sign and its letter, such as "+Y".
std::string name_of(Axis axis);

}  // namespace crowdface
