// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace crowdface {

// Kernels do not fuse multiply and add, so that the results of all instruction sets are
// bit-identical to plain loops.

/// Largest number of floats that a kernel may read or write beyond the end of a row.
inline constexpr std::size_t kRowSlack = 16;

/// Fields with one number at each corner of a triangle. Kernels interpolate the fields along a row
/// of texels.
struct InterpolatedFields {
  /// for each corner: `count` numbers, and kRowSlack further floats that may be read
  std::array<const float*, 3> corners;
  std::size_t count;  ///< number of fields
  /// barycentric coordinates of the second and the third corner at the first texel
  std::array<float, 2> barycentrics;
  std::array<float, 2> barycentric_steps;  ///< increase of `barycentrics` from texel to texel
};

/// A row of stored values of a head's texture map, one pointer per channel.
using StoredRow = std::array<const std::uint16_t*, 3>;

/// Computes sums[c][x] = base_c + Σ_h factor_h · heads[h][c][x] for texels x from `begin` to `end`.
/// The fields are the bases of the channels, and then the factors of the heads.
/// \param readable  end of the texels that may be read from the heads' rows, at least `end`
/// \param ramps     working memory: 2 · (fields.count + kRowSlack) floats
/// \param sums      one row for each of the one to three channels. Up to kRowSlack values after
///                  `end` may be overwritten.
void blend_texels(const InterpolatedFields& fields, std::span<const StoredRow> heads,
                  std::size_t begin, std::size_t end, std::size_t readable, std::span<float> ramps,
                  std::span<float* const> sums);

/// Converts pairs of slopes (u, v) to unit normals: the vector (u, v, 1), normalized. Each
/// component lies between −1 and 1, and is encoded as a number in 0 … 65,535.
/// \param slopes  two rows: `count` slopes u and `count` slopes v.
/// \param count   number of normals, at most 65,535.
/// \param out     the encoded normals, count by 3.
/// \return for each component, the sum of its encoded values.
std::array<std::uint64_t, 3> write_unit_normals(std::array<const float*, 2> slopes,
                                                std::size_t count, std::uint16_t* out);

}  // namespace crowdface
