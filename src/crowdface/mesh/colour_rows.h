// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace crowdface {

/// Vertex colours, #V by 3: red, green and blue in sRGB. No rows if the mesh has no colours.
using ColourRows = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// Colours as real numbers, #rows by 3: red, green and blue.
using ColourValues = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

}  // namespace crowdface
