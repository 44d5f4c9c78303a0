// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace crowdface {

/// A linear RGB colour or radiance; 1 is white on the screen.
using LinearRgb = Eigen::Array3f;

/// Converts to 8-bit sRGB. Values above 0.6 are compressed so that highlights do not clip.
std::array<std::uint8_t, 3> to_srgb8(const LinearRgb& light);
/// Converts surface colours to sRGB without the compression of to_srgb8; clamped to [0, 1].
Eigen::Array3f to_srgb(const LinearRgb& colour);
/// Inverse of to_srgb. \param srgb  each in [0, 1].
LinearRgb from_srgb(const Eigen::Array3f& srgb);
/// Table of the linear values of all 8-bit sRGB values.
const std::array<float, 256>& linear_of_srgb8();

}  // namespace crowdface
