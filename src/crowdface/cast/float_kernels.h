// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace crowdface {

// Each product is rounded before it is added: the bits of plain loops, whatever the instruction set.

/// Σ a_i b_i: sixteen sums in single precision within a chunk of 1024, in double across them and the chunks.
double fixed_dot(const float* a, const float* b, std::size_t count);

/// to[i] += factor·from[i]
void add_scaled(float factor, const float* from, std::size_t count, float* to);

/// The same. \return what fixed_dot then says of `to` and itself.
double add_scaled_and_square(float factor, const float* from, std::size_t count, float* to);

/// to[d] += factors[i]·rows[i][d], one i after the other.
/// \param rows  #count by #width
void add_scaled_rows(const float* factors, std::size_t count, const float* rows, std::size_t width,
                     float* to);

/// Adds (query[d] − rows[d][lane])² to the sums of sixteen lanes, one d after the other.
/// \param rows  #dimensions by 16
/// \return whether any sum is still within the bound
bool add_squares(const float* query, const float* rows, std::size_t dimensions, float bound,
                 float* sums);

}  // namespace crowdface
