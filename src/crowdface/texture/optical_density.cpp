// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/optical_density.h"

#include <algorithm>
#include <cmath>

#include "crowdface/io/srgb.h"

namespace crowdface {
namespace {

constexpr double kFloor = 1.0 / 4096;

double scale() {
  static const double value = kMaxDensity / std::log((1 + kFloor) / kFloor);
  return value;
}

double light_of(double density) {
  return (1 + kFloor) * std::exp(-density / scale()) - kFloor;
}

}  // namespace

Density density_of_light(float light) {
  const double clamped = std::clamp(static_cast<double>(light), 0.0, 1.0);
  const double density = scale() * std::log((1 + kFloor) / (clamped + kFloor));
  return static_cast<Density>(std::clamp(std::floor(density + 0.5), 0.0, double{kMaxDensity}));
}

float light_of_density(float density) {
  return static_cast<float>(std::clamp(light_of(static_cast<double>(density)), 0.0, 1.0));
}

const std::vector<Density>& density_by_srgb8() {
  static const std::vector<Density> table = [] {
    std::vector<Density> densities;
    for (int value = 0; value < 256; ++value) {
      densities.push_back(density_of_light(static_cast<float>(linear_of_srgb(value / 255.0))));
    }
    return densities;
  }();
  return table;
}

const std::vector<std::uint8_t>& srgb8_by_density() {
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> values(65536);
    int value = 255;
    for (std::size_t density = 0; density < values.size(); ++density) {
      // Find the nearest sRGB value: lower `value` while the light is below the midpoint between
      // `value` and the next lower value.
      const double light = light_of(static_cast<double>(density));
      while (value > 0 && light < linear_of_srgb((value - 0.5) / 255)) --value;
      values[density] = static_cast<std::uint8_t>(value);
    }
    return values;
  }();
  return table;
}

}  // namespace crowdface
