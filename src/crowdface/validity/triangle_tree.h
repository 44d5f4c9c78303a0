// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/median_split_tree.h"
#include "crowdface/validity/leaf_boxes.h"

namespace crowdface {

/// A median split tree of triangles, without those at a vertex of more than a thousand. Made once for a mesh; boxes around
/// the nodes fit any positions about as the first (TriangleScene).
struct TriangleTree : MedianSplitTree {
  /// Triangles of a leaf: all but the last have so many.
  static constexpr std::uint32_t kLeaf = LeafBoxes::kCount;
  std::vector<LeafCorners> corners;  ///< of the leaves' triangles

  TriangleTree() = default;
  /// \param apart  by so much triangles count as moved along their normals: sheets that lie on each other come
  ///               into different leaves
  TriangleTree(const std::vector<Triangle>& triangles, const Positions& positions,
               double apart = 0);

  std::size_t leaf_count() const { return corners.size(); }
  static std::uint32_t leaf_number(const Node& node) { return node.begin / kLeaf; }
  /// The triangles of a leaf.
  std::span<const std::uint32_t> leaf(std::size_t number) const {
    const std::size_t begin = number * kLeaf;
    return std::span(order).subspan(begin, std::min<std::size_t>(kLeaf, order.size() - begin));
  }
};

}  // namespace crowdface
