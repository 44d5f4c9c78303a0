// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace crowdface {

// Kernels do not fuse multiply and add, so that the results of all instruction sets are
// bit-identical to plain loops.

/// Largest number of floats that a kernel may write beyond the end of a row.
inline constexpr std::size_t kRowSlack = 16;

/// The arithmetic sequence first, first + step, …
struct Ramp {
  float first = 0, step = 0;
};

/// Writes the first `count` values of each arithmetic sequence to one row. May overwrite up to
/// kRowSlack further values in the row.
/// \param rows  the start of each sequence's row.
void write_ramps(std::span<const Ramp> ramps, std::size_t count, float* const* rows);

/// One row of a head's texture map, and the factor by which each texel is multiplied.
struct HeadTextureRow {
  /// one per texel
  const float* factors;
  std::array<const std::uint16_t*, 3> stored;  ///< stored values of each channel
};

/// sums[c][x] += factors[x]·stored[c][x] for x in [begin, end), head by head.
/// \param sums  one row for each of the one to three channels.
void add_products(std::span<const HeadTextureRow> heads, std::size_t begin, std::size_t end,
                  std::span<float* const> sums);

/// Converts slopes to unit normals, (slope, slope, 1) normalized, with components from −1 to 1
/// encoded in 0 … 65,535.
/// \param slopes  two rows of `count` slopes, at most 65,535.
/// \param out     count by 3.
/// \return the sum of each component's encoded values.
std::array<std::uint64_t, 3> write_unit_normals(std::array<const float*, 2> slopes,
                                                std::size_t count, std::uint16_t* out);

}  // namespace crowdface
