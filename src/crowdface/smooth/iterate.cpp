// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/iterate.h"

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"

namespace crowdface {

Columns iterate(const SmoothingOperator& smoothing, const Columns& values, std::uint64_t level) {
  require(values.rows() == smoothing.vertex_count(), "smooth: ", values.rows(), " rows for ",
          smoothing.vertex_count(), " vertices");
  // This code is deliberately simple, because tests of the fast filter use it as the reference.
  Columns now = values, next(values.rows(), values.cols());
  for (std::uint64_t l = 0; l < level; ++l) {
    parallel_for_each(values.rows(), kRowsPerTask, [&](Index i) {
      const auto ring = smoothing.neighbours(i);
      for (Index c = 0; c < values.cols(); ++c) {
        double mean = 0;
        for (const std::uint32_t n : ring) mean += now(n, c);
        mean = ring.empty() ? now(i, c) : mean / static_cast<double>(ring.size());  // Eq. 1
        next(i, c) = smoothing.kind() == OperatorKind::kLazy ? 0.5 * (now(i, c) + mean) : mean;
      }
    });
    now.swap(next);
  }
  return now;
}

}  // namespace crowdface
