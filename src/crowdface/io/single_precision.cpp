// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/single_precision.h"

#include <atomic>
#include <cmath>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/little_endian.h"

namespace crowdface {

Positions round_to_single(const Positions& positions) {
  return positions.unaryExpr([](double value) -> double { return to_single(value); });
}

void require_finite(const Positions& positions, Index vertices, const std::string& what) {
  require(positions.rows() == vertices, what, ": ", positions.rows(), " positions for ", vertices,
          " vertices");
  std::atomic<bool> finite = true;
  parallel_blocks(vertices, kRowsPerBlock, [&](Index begin, Index end) {
    bool all = true;
    for (Index i = 3 * begin; i < 3 * end; ++i) {
      all &= std::isfinite(static_cast<float>(positions.data()[i]));
    }
    if (!all) finite = false;
  });
  if (!finite) {
    throw InvalidInput(concat(what, ": a position is not finite; nothing was written"));
  }
}

Positions read_singles(const char* bytes, Index rows, std::size_t stride, const std::string& what) {
  Positions positions(rows, 3);
  for (Index i = 0; i < rows; ++i) {
    const char* row = bytes + static_cast<std::size_t>(i) * stride;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto single = number_at<float>(row + c * sizeof(float));
      positions(i, static_cast<Index>(c)) = static_cast<double>(single);
    }
  }
  require_finite(positions, rows, what);
  return positions;
}

}  // namespace crowdface
