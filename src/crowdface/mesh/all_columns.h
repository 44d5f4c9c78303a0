// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace crowdface {

/// Column index that selects all columns: `matrix(rows, kAllColumns)`. Eigen 3.4 names this value
/// Eigen::all, and Eigen 5 names it Eigen::placeholders::all. Each version rejects the name of the
/// other version or warns about it.
inline const Eigen::placeholders::all_t kAllColumns{};

}  // namespace crowdface
