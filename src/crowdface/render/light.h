// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace crowdface {

/// Light, linear, red green blue; 1 is white on the screen.
using Light = Eigen::Array3f;

/// As a screen shows it: sRGB's transfer curve, rounded to 8 bits.
std::array<std::uint8_t, 3> to_srgb8(const Light& light);
/// The same transfer curve alone: a colour of a surface as it is chosen on a screen.
Eigen::Array3f to_srgb(const Light& colour);
/// The inverse, for colours chosen on a screen; each in [0, 1].
Light from_srgb(const Eigen::Array3f& srgb);
/// What from_srgb makes of each value of a channel of 8 bits.
const std::array<float, 256>& light_of_srgb8();

}  // namespace crowdface
