// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace crowdface {

/// Adds (query[d] − rows[d][lane])² to the sums of sixteen lanes, one d after the other.
/// \param rows  #dimensions by 16
/// \return whether any sum is still within the bound
bool add_squares(const float* query, const float* rows, std::size_t dimensions, float bound,
                 float* sums);

}  // namespace crowdface
