// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

SmoothingOperator::SmoothingOperator(const Adjacency& adjacency, Boundary boundary,
                                     OperatorKind kind)
    : kind_(kind) {
  neighbours_.reserve(adjacency.group_count(), adjacency.items.size());
  for (Index i = 0; i < adjacency.vertex_count(); ++i) {
    const bool stays =
        boundary == Boundary::kFixed && adjacency.boundary[static_cast<std::size_t>(i)];
    neighbours_.add_group(stays ? std::span<const std::uint32_t>() : adjacency.items_of(i));
  }
}

}  // namespace crowdface
