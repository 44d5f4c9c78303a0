// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace crowdface {

/// #V by C values, one row a vertex: the coordinates of one or several heads side by side.
using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Rows that one parallel task works on. Fixed, so that results do not depend on the thread count.
inline constexpr Eigen::Index kRowBlock = 4096;

}  // namespace crowdface
