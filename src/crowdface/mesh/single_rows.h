// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace crowdface {

/// Positions or displacements in single precision, one a row.
using SingleRows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

}  // namespace crowdface
