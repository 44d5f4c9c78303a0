// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "crowdface/validity/leaf_boxes.h"
#include "crowdface/validity/triangle_tree.h"

namespace crowdface {

/// Indices of two triangles, the smaller first.
using TrianglePair = std::pair<std::uint32_t, std::uint32_t>;

/// The triangles of one mesh in a bounding volume hierarchy, for proximity and ray queries. Boxes
/// have single precision and are rounded outwards, so that they contain the exact boxes; triangle
/// tests use double precision.
class TriangleScene {
 public:
  /// \param triangles, tree, positions  must outlive the scene; the tree must be built of
  ///        `triangles`.
  /// \param margin  distance by which the boxes grow on all sides.
  TriangleScene(const std::vector<Triangle>& triangles, const TriangleTree& tree,
                const Positions& positions, double margin);

  /// Returns the pairs of triangles whose boxes overlap and that share no vertex, ascending. Omits
  /// triangles at vertices with more than a thousand triangles, because the tree does not contain
  /// them.
  std::vector<TrianglePair> near_pairs() const;

  /// Returns the pairs from near_pairs() whose triangles intersect, ascending.
  std::vector<TrianglePair> intersecting_pairs() const;

  /// Returns the leaves i ≥ `leaf`, ascending, in which the box of a triangle may overlap the box
  /// of a triangle in `leaf`.
  std::vector<std::uint32_t> leaves_near(std::uint32_t leaf) const;

  /// Finds any triangle that a ray hits, not necessarily the nearest; ignores triangle `start`.
  /// Returns the position of the found triangle in the tree's order, or kNoIndex if there is none.
  /// \param direction  of any length except zero
  /// \param start      index of the triangle from which the ray starts, or kNoIndex
  /// \param guess      position in the tree's order to test first, usually the previous ray's
  ///                   result, because neighbouring rays often hit the same triangle; or kNoIndex
  std::uint32_t find_any_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                             std::uint32_t start, std::uint32_t guess) const;

 private:
  struct NodePair {
    std::uint32_t a, b;
  };

  bool are_leaves(const NodePair& pair) const {
    return tree_.nodes[pair.a].is_leaf() && tree_.nodes[pair.b].is_leaf();
  }
  void split(const NodePair& pair, std::vector<NodePair>& into) const;
  /// Returns pairs of nodes that together contain all pairs of leaves that may overlap. Each pair
  /// is one parallel task.
  std::vector<NodePair> initial_node_pairs() const;
  template <class Use>
  void visit_leaves(const NodePair& from, const Use& use) const;
  template <class Keep>
  std::vector<TrianglePair> filtered_pairs(const Keep& keep) const;
  /// \param one, other  leaf numbers, equal or in ascending order
  /// \param keep        keep(pair): whether to return the pair
  template <class Keep>
  void compare_leaves(std::uint32_t one, std::uint32_t other, const Keep& keep,
                      std::vector<TrianglePair>& found) const;

  const std::vector<Triangle>& triangles_;
  const TriangleTree& tree_;
  const Positions& positions_;
  std::vector<LeafBoxes> leaves_;
  std::vector<Box> boxes_;  ///< boxes of the tree's nodes
};

}  // namespace crowdface
