// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "crowdface/mesh/adjacency.h"

namespace crowdface {

/// What happens to vertices on an open boundary (an edge with one face).
enum class Boundary {
  kFixed,  ///< they stay where they are, so that rims keep their shape
  kFree,   ///< they are averaged like all others
};

enum class OperatorKind {
  kUmbrella,  ///< Eq. 1: the mean of the edge-neighbours, W
  kLazy,      ///< (x + W x)/2, which lets no checkerboard survive on quads
};

/// The linear map that one smoothing iteration applies to positions (Eq. 1), in the form that the
/// products use: neighbours of the vertices that move, none for those that stay.
class SmoothingOperator {
 public:
  SmoothingOperator(const Adjacency& adjacency, Boundary boundary, OperatorKind kind);

  Index vertex_count() const { return static_cast<Index>(neighbours_.group_count()); }
  OperatorKind kind() const { return kind_; }

  /// Neighbours of vertex i, ascending; empty if it does not move.
  std::span<const std::uint32_t> neighbours(Index i) const { return neighbours_.of(i); }

 private:
  OperatorKind kind_;
  Grouped<std::uint32_t> neighbours_;  ///< of each vertex
};

}  // namespace crowdface
