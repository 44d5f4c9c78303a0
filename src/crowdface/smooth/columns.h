// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace crowdface {

/// A matrix with one row per vertex and C columns, for example the coordinates of one or more heads
/// side by side.
using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Number of rows in each parallel task. The number is constant, so that results do not depend on
/// the thread count.
inline constexpr Eigen::Index kRowsPerTask = 4096;

}  // namespace crowdface
