// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// The shape of a bounding volume hierarchy: points are split at the median along the axis in which they extend farthest,
/// down to leaves. Whoever uses the tree keeps the boxes of its nodes. All hierarchies of crowdface have this shape, but for
/// pictures, which Embree draws: the last bits of Embree's answers depend on the processor, and those of plans and meshes
/// must not.
struct MedianSplitTree {
  struct Node {
    std::uint32_t begin, end;  ///< of `order`; begin is a multiple of the leaf size
    std::uint32_t second;      ///< the second child; the first child is the next node; 0: a leaf

    bool is_leaf() const { return second == 0; }
  };

  using Points =
      Eigen::Ref<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

  std::vector<std::uint32_t> order;  ///< rows of the points; the rows of a node stand together
  std::vector<Node> nodes;           ///< parents before their children; empty if there are no rows

  MedianSplitTree() = default;
  /// \param rows       of the points in the tree.
  /// \param points     of any dimension.
  /// \param leaf_size  rows of each leaf; the last leaf may hold fewer.
  MedianSplitTree(std::vector<std::uint32_t> rows, const Points& points, std::uint32_t leaf_size);
};

}  // namespace crowdface
