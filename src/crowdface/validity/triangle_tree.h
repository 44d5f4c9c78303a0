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

/// A median split tree of the triangles of a mesh, without triangles at vertices with more than a
/// thousand triangles. Build the tree once for each mesh topology: TriangleScene fits the boxes to
/// any positions. The boxes are small if the positions are similar to the positions from which the
/// tree was built.
struct TriangleTree : MedianSplitTree {
  /// Number of triangles in a leaf; the last leaf may have fewer.
  static constexpr std::uint32_t kLeafSize = LeafBoxes::kMaxTriangles;
  std::vector<LeafCorners> corners;  ///< for each leaf, the corners of the leaf's triangles

  TriangleTree() = default;
  /// \param normal_offset  distance, in the unit of the positions, by which triangles are shifted
  ///                       along their normals before the tree is split. The shift puts layers of
  ///                       skin that touch each other into different leaves.
  TriangleTree(const std::vector<Triangle>& triangles, const Positions& positions,
               double normal_offset = 0);

  std::size_t leaf_count() const { return corners.size(); }
  /// Returns the number of a leaf, which is its index into `corners`.
  static std::uint32_t leaf_number(const Node& node) { return node.begin / kLeafSize; }
  /// Returns the indices of the triangles in a leaf.
  std::span<const std::uint32_t> leaf(std::size_t number) const {
    const std::size_t begin = number * kLeafSize;
    return std::span(order).subspan(begin, std::min<std::size_t>(kLeafSize, order.size() - begin));
  }
};

}  // namespace crowdface
