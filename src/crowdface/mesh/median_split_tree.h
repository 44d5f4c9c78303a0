// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// The tree of a bounding volume hierarchy, without bounding boxes. Each inner node splits its
/// points at the median of the axis along which the points extend farthest. The users of the tree
/// store the boxes of the nodes. Casting plans and mesh operations use this tree instead of Embree,
/// because the last bits of Embree's results depend on the processor. Rendering uses Embree.
struct MedianSplitTree {
  /// A node of the tree, which holds a range of the points.
  struct Node {
    /// The points of this node are order[begin] … order[end − 1]; `begin` is a multiple of the leaf
    /// size.
    std::uint32_t begin, end;
    /// Index of the second child, 0 in a leaf; the first child is the next node.
    std::uint32_t second_child;

    bool is_leaf() const { return second_child == 0; }
  };

  using Points =
      Eigen::Ref<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

  /// row indices of the points, ordered so that the rows of each node are contiguous
  std::vector<std::uint32_t> order;
  /// all nodes; each parent comes before its children; empty if the tree holds no points
  std::vector<Node> nodes;

  MedianSplitTree() = default;
  /// \param rows       rows of `points` that the tree holds.
  /// \param points     points of any dimension, one in each row.
  /// \param leaf_size  number of rows in each leaf; the last leaf may hold fewer.
  MedianSplitTree(std::vector<std::uint32_t> rows, const Points& points, std::uint32_t leaf_size);
};

}  // namespace crowdface
