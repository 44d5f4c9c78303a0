// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "crowdface/validity/triangle_tree.h"

namespace crowdface {

/// Two triangles by their numbers, the smaller first.
using TrianglePair = std::pair<std::uint32_t, std::uint32_t>;

/// Triangles of one mesh in a tree of boxes, to be asked which are near each other and what a ray meets. Boxes are in
/// single precision and never smaller than in double; triangles are tested in double precision.
class TriangleScene {
 public:
  /// \param triangles, tree, positions  must outlive the scene; the tree is of these triangles.
  /// \param margin  by which boxes are grown on all sides.
  TriangleScene(const std::vector<Triangle>& triangles, const TriangleTree& tree,
                const Positions& positions, double margin);

  /// Pairs without a common vertex whose boxes overlap, ascending. Triangles at a vertex of more than a
  /// thousand are left out.
  std::vector<TrianglePair> near_pairs() const;

  /// Whether a ray meets a triangle other than the one it starts from.
  /// \param direction  of any length but zero.
  bool meets(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
             std::uint32_t start) const;

 private:
  /// Boxes of a leaf's triangles, coordinate by coordinate; of what it lacks empty.
  struct LeafBoxes {
    std::array<std::array<float, TriangleTree::kLeaf>, 3> low, high;
  };
  struct Box {
    std::array<float, 3> low, high;
  };
  struct NodePair {
    std::uint32_t a, b;
  };

  Box box_of(const LeafBoxes& leaf) const;
  bool overlap(const NodePair& pair) const;
  void split(const NodePair& pair, std::vector<NodePair>& into) const;
  void compare_leaves(const NodePair& pair, std::vector<TrianglePair>& found) const;

  const std::vector<Triangle>& triangles_;
  const TriangleTree& tree_;
  const Positions& positions_;
  std::vector<LeafBoxes> leaves_;  ///< by `begin` of a leaf over kLeaf
  std::vector<Box> boxes_;         ///< of the nodes
};

}  // namespace crowdface
