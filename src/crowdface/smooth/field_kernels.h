// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace crowdface {

/// to[i] = from[i]·scale, rounded to the nearest whole number, halves to even.
/// \param from  times scale from −32768 to 32767
void narrow(const float* from, std::size_t count, float scale, std::int16_t* to);

/// What the first few fields of some vertices leave out of a level.
struct MissedLevel {
  std::size_t kept = 0;   ///< fields
  float squared = 0;      ///< the largest squared distance missed
  std::size_t level = 0;  ///< where
};

/// The fewest first fields with which no vertex of a tile misses any level Σ_p functions[level][p]·fields[p] by more than the
/// root of `most`.
/// \param fields     `count` by 3 by kFieldTile
/// \param functions  `levels` rows of `count`, `stride` apart
MissedLevel keep_fewest(const float* fields, std::size_t count, const float* functions,
                        std::size_t stride, std::size_t levels, float most);

/// products[i] = Σ_c columns[c][i]·columns[c][row] in double precision, in the order of c with one rounding a term.
/// \param columns   `count` by kPatchVertices
/// \param products  kPatchVertices
void row_products(const float* columns, std::size_t count, std::size_t row, double* products);

}  // namespace crowdface
