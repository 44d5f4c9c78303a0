// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "crowdface/validity/leaf_boxes.h"
#include "crowdface/validity/triangle_tree.h"

namespace crowdface {

/// Indices of two triangles; the smaller index comes first.
using TrianglePair = std::pair<std::uint32_t, std::uint32_t>;

/// The triangles of one mesh in a bounding volume hierarchy, for proximity and ray queries. Boxes
/// are stored in single precision and rounded outwards, so that they contain the exact boxes. Tests
/// of triangles use double precision.
class TriangleScene {
 public:
  /// \param triangles, tree, positions  must outlive the scene. The tree must have been built from
  /// `triangles`.
  /// \param margin  distance by which the boxes grow on all sides.
  TriangleScene(const std::vector<Triangle>& triangles, const TriangleTree& tree,
                const Positions& positions, double margin);

  /// Returns the pairs of triangles whose boxes overlap but which share no vertex, in ascending
  /// order. Omits triangles at vertices with more than a thousand triangles, because the tree omits
  /// these triangles.
  std::vector<TrianglePair> near_pairs() const;

  /// Returns the pairs from near_pairs() whose triangles intersect, ascending.
  std::vector<TrianglePair> intersecting_pairs() const;

  /// Returns, in ascending order, the leaves i ≥ `leaf` that may contain a triangle whose box
  /// overlaps the box of a triangle in `leaf`.
  std::vector<std::uint32_t> leaves_near(std::uint32_t leaf) const;

  /// Finds any triangle that a ray hits, not necessarily the nearest such triangle. Returns the
  /// found triangle's position in the order of the tree, or kNoIndex if the ray hits no triangle.
  ///
  /// \param direction  of any length except zero
  /// \param start      index of the triangle from which the ray starts; the search ignores this
  ///                   triangle. kNoIndex: no triangle is ignored
  /// \param guess      position (in the order of the tree) of the triangle to test first, or
  ///                   kNoIndex. Usually the result for the previous ray, because neighbouring rays
  ///                   often hit the same triangle.
  std::uint32_t find_any_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                             std::uint32_t start, std::uint32_t guess) const;

 private:
  /// Two nodes of the tree, as indices into its `nodes`; both may be the same node.
  struct NodePair {
    std::uint32_t a, b;
  };

  bool are_leaves(const NodePair& pair) const {
    return tree_.nodes[pair.a].is_leaf() && tree_.nodes[pair.b].is_leaf();
  }
  /// Divides a pair of nodes into pairs of smaller nodes. Adds to `into` each of these pairs in
  /// which the boxes of the two nodes overlap.
  void split(const NodePair& pair, std::vector<NodePair>& into) const;
  /// Returns pairs of nodes, one for each parallel task. Together, the subtrees of the pairs
  /// contain all pairs of leaves that overlap.
  std::vector<NodePair> initial_node_pairs() const;
  /// Calls use(one, other) for each pair of leaves with overlapping boxes. One leaf is below the
  /// first node of `from`, and the other leaf is below the second node.
  template <class Use>
  void visit_leaves(const NodePair& from, const Use& use) const;
  /// Returns the pairs of near_pairs() for which keep(pair) is true, ascending.
  template <class Keep>
  std::vector<TrianglePair> filtered_pairs(const Keep& keep) const;
  /// Compares the triangles of one leaf with the triangles of another leaf. Appends to `found` the
  /// pairs of triangles whose boxes overlap and which share no vertex.
  ///
  /// \param one, other  numbers of the two leaves, equal or in ascending order
  /// \param keep        keep(pair): whether to append the pair
  template <class Keep>
  void compare_leaves(std::uint32_t one, std::uint32_t other, const Keep& keep,
                      std::vector<TrianglePair>& found) const;

  const std::vector<Triangle>& triangles_;
  const TriangleTree& tree_;
  const Positions& positions_;
  std::vector<LeafBoxes> leaves_;  ///< for each leaf of the tree, the boxes of its triangles
  std::vector<Box> boxes_;         ///< the bounding box of each node of the tree
};

}  // namespace crowdface
