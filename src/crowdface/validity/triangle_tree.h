// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// Triangles in an order in which those that lie near each other stand together, and halves of it, halves of those
/// and so on. Made once for a mesh; boxes around them fit any positions about as the first (TriangleScene).
struct TriangleTree {
  /// Triangles of a leaf: all but the last have so many.
  static constexpr std::uint32_t kLeaf = 8;
  struct Node {
    std::uint32_t begin, end;  ///< of `order`; begin is a multiple of kLeaf
    std::uint32_t right;       ///< the second child, the first is the next node; 0: a leaf
  };

  std::vector<std::uint32_t> order;  ///< without triangles at a vertex of more than a thousand
  std::vector<Node> nodes;           ///< parents first; empty if there are no triangles

  TriangleTree() = default;
  TriangleTree(const std::vector<Triangle>& triangles, const Positions& positions);
};

}  // namespace crowdface
