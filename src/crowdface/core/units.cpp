// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/units.h"

#include "crowdface/core/text.h"

namespace crowdface {

double mm_per(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::kMillimetre:
      return 1;
    case LengthUnit::kCentimetre:
      return 10;
    case LengthUnit::kMetre:
      return 1000;
    case LengthUnit::kInch:
      return 25.4;
  }
  return 1;
}

std::string_view name_of(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::kMillimetre:
      return "mm";
    case LengthUnit::kCentimetre:
      return "cm";
    case LengthUnit::kMetre:
      return "m";
    case LengthUnit::kInch:
      return "in";
  }
  return "mm";
}

std::optional<LengthUnit> parse_length_unit(std::string_view name) {
  for (const LengthUnit unit :
       {LengthUnit::kMillimetre, LengthUnit::kCentimetre, LengthUnit::kMetre, LengthUnit::kInch}) {
    if (name == name_of(unit)) return unit;
  }
  return std::nullopt;
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
