// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "crowdface/mesh/colour_rows.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Converts linear light to sRGB (IEC 61966-2-1), both from 0 to 1.
inline double srgb_of_linear(double light) {
  light = std::clamp(light, 0.0, 1.0);
  if (light == 1) return 1;  // avoids a rounding error in the last digit
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}
/// Converts sRGB to linear light, both from 0 to 1.
inline double linear_of_srgb(double value) {
  value = std::clamp(value, 0.0, 1.0);
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// Converts vertex colours from sRGB bytes to linear light (#V by 3, 0 to 1), as GLB and USD store
/// vertex colours.
inline ColourValues linear_light(const ColourRows& colours) {
  constexpr double kMaxByte = 255;
  ColourValues linear(colours.rows(), 3);
  for (Index i = 0; i < colours.size(); ++i) {
    linear.data()[i] = linear_of_srgb(colours.data()[i] / kMaxByte);
  }
  return linear;
}

}  // namespace crowdface
