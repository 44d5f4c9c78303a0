// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "crowdface/smooth/columns.h"
#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface::detail {

/// Eq. 1 for rows [begin, end): hands `use(row, mean)` the mean of each row's neighbours, C
/// numbers; a row that does not move is its own mean. Neighbours are added in ascending order, so
/// that the bits depend on nothing but the values.
template <int kColumns, class Use>
void for_each_mean(const SmoothingOperator& smoothing, const double* values, Index begin, Index end,
                   const Use& use) {
  for (Index i = begin; i < end; ++i) {
    const auto ring = smoothing.neighbours(i);
    if (ring.empty()) {
      use(i, values + i * kColumns);
      continue;
    }
    double mean[kColumns] = {};
    for (const std::uint32_t n : ring) {
      const double* neighbour = values + static_cast<Index>(n) * kColumns;
      for (int c = 0; c < kColumns; ++c) mean[c] += neighbour[c];
    }
    const double share = 1.0 / static_cast<double>(ring.size());
    for (int c = 0; c < kColumns; ++c) mean[c] *= share;
    use(i, mean);
  }
}

/// Calls `body.template operator()<C>()` with the number of columns as a constant, so that the
/// inner loops unroll. Columns come in threes, the coordinates of a vertex.
template <class Body>
void with_column_count(Index columns, const Body& body) {
  switch (columns) {
    case 3:
      return body.template operator()<3>();
    case 6:
      return body.template operator()<6>();
    case 9:
      return body.template operator()<9>();
    default:
      return body.template operator()<12>();
  }
}

/// How many columns `with_column_count` takes at a time of `left`.
inline Index columns_at_a_time(Index left) {
  return left >= 12 ? 12 : left;
}

}  // namespace crowdface::detail
