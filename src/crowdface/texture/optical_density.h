// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace crowdface {

/// How much light a surface keeps back: −ln of what it reflects, so that the densities of pigments in it
/// add up. 0 is white; 65,535 black, which has a finite density because a four-thousandth of the light is
/// added to all. Steps are finer than those of 8-bit sRGB everywhere.
using Density = std::uint16_t;
inline constexpr float kMostDensity = 65535;

/// \param light  linear, 0 … 1; what lies beyond counts as the end.
Density density_of_light(float light);
/// The inverse.
float light_of_density(float density);

/// Of each 8-bit sRGB value, and the 8-bit sRGB value of each density: there and back gives the same.
const std::vector<Density>& densities_of_srgb8();
const std::vector<std::uint8_t>& srgb8_of_densities();

}  // namespace crowdface
