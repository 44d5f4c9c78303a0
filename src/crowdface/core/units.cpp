// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/units.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "crowdface/core/text.h"

namespace crowdface {

namespace {

struct NamedUnit {
  std::string_view name;
  LengthUnit unit;
};
/// A unit may have several names in this list; `name_of` returns the first.
constexpr std::array<NamedUnit, 7> kNamedUnits = {{{"mm", LengthUnit::kMillimetre},
                                                   {"cm", LengthUnit::kCentimetre},
                                                   {"m", LengthUnit::kMetre},
                                                   {"in", LengthUnit::kInch},
                                                   {"ft", LengthUnit::kFoot},
                                                   {"foot", LengthUnit::kFoot},
                                                   {"feet", LengthUnit::kFoot}}};

std::optional<LengthUnit> unit_called(std::string_view name) {
  for (const NamedUnit& known : kNamedUnits) {
    if (name == known.name) return known.unit;
  }
  return std::nullopt;
}

}  // namespace

std::string name_of(LengthUnit unit) {
  for (const NamedUnit& known : kNamedUnits) {
    if (unit == known.unit) return std::string(known.name);
  }
  return concat(unit.mm, " mm");
}

std::optional<LengthUnit> parse_length_unit(std::string_view text) {
  constexpr double kMinMm = 1e-6, kMaxMm = 1e9;
  if (const auto unit = unit_called(text)) return unit;
  const auto mm = parse_length_mm(text);
  if (!mm || !(*mm >= kMinMm && *mm <= kMaxMm)) return std::nullopt;
  return LengthUnit{*mm};
}

LengthUnit nearest_unit(double length, double typical_mm, std::span<const LengthUnit> units) {
  const auto distance = [&](LengthUnit unit) {
    const double ratio = std::max(length * mm_per(unit), 1e-9) / typical_mm;
    return std::max(ratio, 1 / ratio);
  };
  return *std::ranges::min_element(units, {}, distance);
}

LengthUnit fitting_unit(double length, double typical_mm) {
  constexpr LengthUnit kPoser{2438.4};  // the only unusual unit of a widespread program
  constexpr double kNear = 1.1;         // people differ by more, but seldom
  const double mm = typical_mm / std::max(length, 1e-9);
  if (mm <= kNear * kPoser.mm && mm >= kPoser.mm / kNear) return kPoser;
  const double step = std::pow(10, std::floor(std::log10(mm)) - 1);
  const double digits = std::round(mm / step);
  // The result is a multiple of `step`, the unit of the second significant digit. If `step` is
  // below 1, divide by 1/step, which is a whole number; multiplying by 0.1 would give
  // 2.3000000000000003 instead of 2.3.
  return {step < 1 ? digits / std::round(1 / step) : digits * step};
}

std::optional<double> parse_length_mm(std::string_view text) {
  const std::size_t unit_start = text.find_last_not_of("abcdefghijklmnopqrstuvwxyz") + 1;
  const auto unit = unit_called(text.substr(unit_start));
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
