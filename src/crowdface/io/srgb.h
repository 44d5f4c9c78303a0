// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "crowdface/mesh/colour_rows.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Between light and what files of 8 bits hold of it (IEC 61966-2-1), both from 0 to 1.
inline double srgb_of_linear(double light) {
  light = std::clamp(light, 0.0, 1.0);
  if (light == 1) return 1;  // not the last digit less
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}
inline double linear_of_srgb(double value) {
  value = std::clamp(value, 0.0, 1.0);
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// Colours at vertices as GLB and USD have them.
inline Positions linear_light(const ColourRows& colours) {
  constexpr double kMostByte = 255;
  Positions light(colours.rows(), 3);
  for (Index i = 0; i < colours.size(); ++i) {
    light.data()[i] = linear_of_srgb(colours.data()[i] / kMostByte);
  }
  return light;
}

}  // namespace crowdface
