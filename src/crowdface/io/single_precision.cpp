// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/single_precision.h"

#include <atomic>
#include <cmath>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"

namespace crowdface {

void require_finite(const Positions& positions, Index vertices, const std::string& what) {
  if (positions.rows() != vertices) {
    throw InvalidInput(concat(what, ": expected ", vertices, " positions, got ", positions.rows()));
  }
  constexpr Index kRowsPerBlock = 1 << 16;
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

}  // namespace crowdface
