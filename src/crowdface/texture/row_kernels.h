// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "crowdface/texture/optical_density.h"

namespace crowdface {

// Each product is rounded before it is added: the bits of plain loops, whatever the instruction set.

/// Rows may be written up to so many floats beyond their end.
inline constexpr std::size_t kRowSlack = 16;

/// A straight line: first, first + step, …
struct Ramp {
  float first = 0, step = 0;
};

/// Writes `count` values of each line, and up to kRowSlack more. \param rows  #ramps
void write_ramps(std::span<const Ramp> ramps, std::size_t count, float* const* rows);

/// A row of what one head lends.
struct LentRow {
  const float* factors;
  std::array<const Density*, 3> stored;  ///< of each channel
};

/// sums[c][x] += factors[x]·stored[c][x] for x in [begin, end), one head after the other.
/// \param sums  #channels, up to three
void add_products(std::span<const LentRow> heads, std::size_t begin, std::size_t end,
                  std::span<float* const> sums);

}  // namespace crowdface
