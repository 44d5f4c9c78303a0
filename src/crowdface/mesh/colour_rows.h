// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace crowdface {

/// #V by 3 red, green and blue of vertices, sRGB; or no rows.
using ColourRows = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

}  // namespace crowdface
