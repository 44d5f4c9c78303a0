// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace crowdface {

/// The second index of `matrix(rows, kAllColumns)`. Eigen 3.4 calls it Eigen::all, Eigen 5 Eigen::placeholders::all; each refuses,
/// or warns of, the other's name.
inline const Eigen::placeholders::all_t kAllColumns{};

}  // namespace crowdface
