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

/// A median split tree of triangles, without the triangles at vertices with more than a thousand
/// triangles. Build the tree once per mesh: TriangleScene refits the boxes to any positions, and
/// the boxes stay tight if the positions are similar to the constructor's.
struct TriangleTree : MedianSplitTree {
  /// Triangles per leaf; the last leaf may have fewer.
  static constexpr std::uint32_t kLeafSize = LeafBoxes::kCount;
  std::vector<LeafCorners> corners;  ///< corners of each leaf's triangles

  TriangleTree() = default;
  /// \param normal_offset  distance by which triangles are shifted along their normals before the
  ///                       split, in the unit of the positions. The shift puts sheets that lie on
  ///                       each other into different leaves.
  TriangleTree(const std::vector<Triangle>& triangles, const Positions& positions,
               double normal_offset = 0);

  std::size_t leaf_count() const { return corners.size(); }
  static std::uint32_t leaf_number(const Node& node) { return node.begin / kLeafSize; }
  /// The triangle indices of a leaf.
  std::span<const std::uint32_t> leaf(std::size_t number) const {
    const std::size_t begin = number * kLeafSize;
    return std::span(order).subspan(begin, std::min<std::size_t>(kLeafSize, order.size() - begin));
  }
};

}  // namespace crowdface
