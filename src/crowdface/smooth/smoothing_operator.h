// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "crowdface/mesh/adjacency.h"

namespace crowdface {

/// How smoothing treats vertices on an open boundary, which consists of edges with only one
/// polygon.
enum class Boundary {
  kFixed,  ///< boundary vertices do not move, so that the borders of openings keep their shape
  kFree,   ///< boundary vertices are averaged like all other vertices
};

/// The linear map that one smoothing iteration applies to the positions x.
enum class OperatorKind {
  kUmbrella,  ///< the map W: W x has, for each vertex, the mean of its edge-neighbours (Eq. 1)
  kLazy,      ///< the map (x + W x)/2 with the W of kUmbrella; removes checkerboards of quad meshes
};

/// The linear map of one smoothing iteration (Eq. 1), stored as neighbour lists. Fixed vertices
/// have an empty list.
class SmoothingOperator {
 public:
  SmoothingOperator(const Adjacency& adjacency, Boundary boundary, OperatorKind kind);

  Index vertex_count() const { return static_cast<Index>(neighbours_.group_count()); }
  OperatorKind kind() const { return kind_; }

  /// Neighbours of vertex i, ascending; empty if vertex i is fixed.
  std::span<const std::uint32_t> neighbours(Index i) const { return neighbours_.items_of(i); }

 private:
  OperatorKind kind_;
  /// neighbours of each vertex, ascending; none for fixed vertices
  CompressedRows<std::uint32_t> neighbours_;
};

}  // namespace crowdface
