// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

SmoothingOperator::SmoothingOperator(const Adjacency& adjacency, Boundary boundary,
                                     OperatorKind kind)
    : kind_(kind) {
  offsets_.reserve(adjacency.offsets.size());
  neighbours_.reserve(adjacency.neighbours.size());
  offsets_.push_back(0);
  for (Index i = 0; i < adjacency.vertex_count(); ++i) {
    const bool stays =
        boundary == Boundary::kFixed && adjacency.boundary[static_cast<std::size_t>(i)];
    if (!stays) {
      const auto ring = adjacency.of(i);
      neighbours_.insert(neighbours_.end(), ring.begin(), ring.end());
    }
    offsets_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
  }
}

}  // namespace crowdface
