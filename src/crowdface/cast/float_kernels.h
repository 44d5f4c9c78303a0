// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace crowdface {

// Vectorised kernels. Each product is rounded before it is added, so the results are bit-identical
// to the results of plain loops on every instruction set.

/// Returns Σ a_i b_i. Each chunk of 1024 numbers is added up in sixteen single-precision sums;
/// these sums are then added in double precision.
double fixed_order_dot(const float* a, const float* b, std::size_t count);

/// Computes to[i] += factor·from[i].
void add_scaled(float factor, const float* from, std::size_t count, float* to);

/// Like add_scaled, but also returns the sum of the squares of the new values in `to`. The sum is
/// bit-identical to fixed_order_dot(to, to, count).
double add_scaled_and_sum_squares(float factor, const float* from, std::size_t count, float* to);

/// Adds the product of two matrices: to[v][d] += factors[v][i]·rows[i][d], for all i in ascending
/// order. Rows whose factors are zero cost little.
///
/// \param factors  #vectors by #count.
/// \param rows     #count by #width.
/// \param to       #vectors by #width.
void add_product(const float* factors, std::size_t vectors, std::size_t count, const float* rows,
                 std::size_t width, float* to);

/// For each of sixteen lanes, adds (query[d] − rows[d][lane])² to the lane's sum, in ascending
/// order of d.
///
/// \param rows  `dimensions` by 16.
/// \return      Whether at least one sum is still at most `bound`.
bool add_squares(const float* query, const float* rows, std::size_t dimensions, float bound,
                 float* sums);

}  // namespace crowdface
