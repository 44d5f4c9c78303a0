// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "crowdface/validity/leaf_boxes.h"
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

  /// Those of the near pairs that pass through each other; ascending.
  std::vector<TrianglePair> crossing_pairs() const;

  /// Leaves of the tree, from this one on, with triangles whose boxes may overlap some of its own; ascending.
  std::vector<std::uint32_t> leaves_near(std::uint32_t leaf) const;

  /// A triangle other than the one it starts from that a ray meets, not the nearest, by its place in the tree's
  /// order; kNoIndex if it meets none.
  /// \param direction  of any length but zero
  /// \param start      a triangle's number, or kNoIndex
  /// \param guess      a place that is tried first, as what is in the way of one ray is in that of the next; or
  ///                   kNoIndex
  std::uint32_t met_by(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                       std::uint32_t start, std::uint32_t guess) const;

 private:
  struct NodePair {
    std::uint32_t a, b;
  };

  bool are_leaves(const NodePair& pair) const {
    return tree_.nodes[pair.a].is_leaf() && tree_.nodes[pair.b].is_leaf();
  }
  void split(const NodePair& pair, std::vector<NodePair>& into) const;
  /// Pairs of nodes that together hold all pairs of leaves that may overlap.
  std::vector<NodePair> first_pairs() const;
  template <class Use>
  void visit_leaves(const NodePair& from, const Use& use) const;
  template <class Keep>
  std::vector<TrianglePair> pairs_with(const Keep& keep) const;
  /// \param one, other  the same leaf, or the one that comes first in the tree first
  /// \param keep        which of the pairs are wanted
  template <class Keep>
  void compare_leaves(std::uint32_t one, std::uint32_t other, const Keep& keep,
                      std::vector<TrianglePair>& found) const;

  const std::vector<Triangle>& triangles_;
  const TriangleTree& tree_;
  const Positions& positions_;
  std::vector<LeafBoxes> leaves_;
  std::vector<Box> boxes_;  ///< of the nodes
};

}  // namespace crowdface
