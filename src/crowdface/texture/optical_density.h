// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace crowdface {

/// Optical density: −ln of the reflected light, quantized to 16 bits. Densities of pigments add up.
/// Value 0 is white and 65,535 black; 1/4096 is added to all light, so that black has a finite
/// density. One step of the quantized density is finer than one step of 8-bit sRGB for every
/// colour.
using Density = std::uint16_t;
inline constexpr float kMaxDensity = 65535;  ///< largest quantized density: black
/// Optical densities as real numbers, #rows by 3: red, green and blue.
using OpticalDensities = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The optical density −log(light) of a linear colour value.
/// \param light  0 … 1; clamped to this range.
Density density_of_light(float light);
/// The inverse of density_of_light: linear light, 0 … 1.
float light_of_density(float density);

/// Lookup table: the density of each 8-bit sRGB value.
const std::vector<Density>& density_by_srgb8();
/// Lookup table: the nearest 8-bit sRGB value of each density. Converting an sRGB value to density
/// and back returns the same value.
const std::vector<std::uint8_t>& srgb8_by_density();

}  // namespace crowdface
