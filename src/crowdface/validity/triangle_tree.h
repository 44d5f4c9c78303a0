// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/validity/leaf_boxes.h"

namespace crowdface {

/// Triangles in an order in which those that lie near each other stand together, and halves of it, halves of those
/// and so on. Made once for a mesh; boxes around them fit any positions about as the first (TriangleScene).
struct TriangleTree {
  /// Triangles of a leaf: all but the last have so many.
  static constexpr std::uint32_t kLeaf = LeafBoxes::kCount;
  struct Node {
    std::uint32_t begin, end;  ///< of `order`; begin is a multiple of kLeaf
    std::uint32_t right;       ///< the second child, the first is the next node; 0: a leaf

    bool is_leaf() const { return right == 0; }
    std::uint32_t leaf() const { return begin / kLeaf; }
  };

  std::vector<std::uint32_t> order;  ///< without triangles at a vertex of more than a thousand
  std::vector<Node> nodes;           ///< parents first; empty if there are no triangles
  std::vector<LeafCorners> corners;  ///< of the leaves' triangles

  TriangleTree() = default;
  /// \param apart  by so much triangles count as moved along their normals: sheets that lie on each other come
  ///               into different leaves
  TriangleTree(const std::vector<Triangle>& triangles, const Positions& positions,
               double apart = 0);

  std::size_t leaf_count() const { return corners.size(); }
  /// The triangles of a leaf.
  std::span<const std::uint32_t> leaf(std::size_t number) const {
    const std::size_t begin = number * kLeaf;
    return std::span(order).subspan(begin, std::min<std::size_t>(kLeaf, order.size() - begin));
  }
};

}  // namespace crowdface
