// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace crowdface {

/// Computes to[i] = from[i]·scale, rounded to the nearest integer (halves to the even integer).
/// \param from  `count` values; from[i]·scale must lie between −32768 and 32767.
void round_to_int16(const float* from, std::size_t count, float scale, std::int16_t* to);

/// The error of a tile that keeps only its first `kept_fields` fields and omits all further fields.
struct TruncationError {
  std::size_t kept_fields = 0;  ///< number of leading fields that the tile keeps
  /// square of the largest displacement error over all vertices and levels
  float squared_error = 0;
  std::size_t level_index = 0;  ///< index of the level with the largest error
};

/// Finds the smallest number of leading fields that a tile must keep, such that omitting the
/// remaining fields moves no vertex by more than √`max_squared_error` at any level. The
/// displacement at a level is Σ_p functions[level][p]·fields[p].
/// \param fields     `count` by 3 by kTileVertices values.
/// \param functions  `levels` rows of `count` values; the rows start `stride` floats apart.
/// \param max_squared_error  the largest allowed squared displacement of a vertex.
TruncationError choose_fewest_fields(const float* fields, std::size_t count, const float* functions,
                                     std::size_t stride, std::size_t levels,
                                     float max_squared_error);

/// Computes products[i] = Σ_c columns[c][i]·columns[c][row] in double precision, added in the order
/// of c by fused multiply-add (one rounding per term).
/// \param columns   `count` by kPatchVertices.
/// \param products  kPatchVertices values.
void row_products(const float* columns, std::size_t count, std::size_t row, double* products);

}  // namespace crowdface
