// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/units.h"

#include <algorithm>
#include <array>

#include "crowdface/core/text.h"

namespace crowdface {

namespace {

struct Unit {
  std::string_view name;
  double mm;
};
/// By their numbers.
constexpr std::array<Unit, 4> kUnits = {{{"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}}};

}  // namespace

double mm_per(LengthUnit unit) {
  return kUnits[static_cast<std::size_t>(unit)].mm;
}

std::string_view name_of(LengthUnit unit) {
  return kUnits[static_cast<std::size_t>(unit)].name;
}

std::optional<LengthUnit> parse_length_unit(std::string_view name) {
  for (std::size_t i = 0; i < kUnits.size(); ++i) {
    if (name == kUnits[i].name) return static_cast<LengthUnit>(i);
  }
  return std::nullopt;
}

LengthUnit nearest_unit(double length, double typical_mm) {
  const auto distance = [&](LengthUnit unit) {
    const double ratio = std::max(length * mm_per(unit), 1e-9) / typical_mm;
    return std::max(ratio, 1 / ratio);
  };
  return std::min({LengthUnit::kMillimetre, LengthUnit::kCentimetre, LengthUnit::kMetre},
                  [&](LengthUnit a, LengthUnit b) { return distance(a) < distance(b); });
}

std::optional<double> parse_length_mm(std::string_view text) {
  const std::size_t unit_start = text.find_last_not_of("abcdefghijklmnopqrstuvwxyz") + 1;
  const auto unit = parse_length_unit(text.substr(unit_start));
  std::string_view number = text.substr(0, unit_start);
  while (number.ends_with(' ')) number.remove_suffix(1);
  const auto value = parse_double(number);
  if (!unit || !value) return std::nullopt;
  return *value * mm_per(*unit);
}

std::optional<Axis> parse_axis(std::string_view text) {
  Axis axis;
  if (text.starts_with('+') || text.starts_with('-')) {
    axis.sign = text.front() == '+' ? 1 : -1;
    text.remove_prefix(1);
  }
  if (text.size() != 1) return std::nullopt;
  const std::size_t index = std::string_view("xyzXYZ").find(text.front());
  if (index == std::string_view::npos) return std::nullopt;
  axis.index = static_cast<int>(index % 3);
  return axis;
}

std::string name_of(Axis axis) {
  return concat(axis.sign > 0 ? '+' : '-', "XYZ"[axis.index]);
}

}  // namespace crowdface
