// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "crowdface/validity/triangle_tree.h"

namespace crowdface {

/// Finds intersecting triangles in many meshes of one topology. A tree over the triangles has
/// leaves of eight neighbouring triangles. The constructor takes one of the meshes and finds the
/// candidates: the pairs of triangles so close that they may intersect on another mesh. Each search
/// compares the bounding boxes of the two triangles of a pair before the exact test.
class CrossingSearch {
 public:
  using Pair = std::array<std::uint32_t, 2>;  ///< indices of two triangles, ascending

  CrossingSearch() = default;
  /// \param triangles  The triangles to search.
  /// \param mesh       #V by 3: the mesh on which the constructor finds candidate pairs.
  /// \param max_distance  Largest straight-line distance between the two triangles of a candidate
  ///                     pair, with the positions of `mesh`.
  /// \param max_facing_distance  The largest distance if the two triangles face each other; at
  ///                   least `max_distance`.
  ///
  /// Two triangles that are connected by a few edges are tested only if their normals differ,
  /// because a surface that is not folded does not intersect itself.
  CrossingSearch(std::vector<Triangle> triangles, const Positions& mesh, double max_distance,
                 double max_facing_distance);

  const std::vector<Triangle>& triangles() const { return triangles_; }

  /// Bounding boxes of one mesh, which `update` keeps up to date between searches.
  struct Boxes {
    FloatPositions points;                  ///< positions of `vertices_`, #vertices_ by 3
    std::vector<LeafBoxes> triangle_boxes;  ///< for each leaf: the boxes of its triangles
    std::vector<LeafNormals> leaf_normals;  ///< for each leaf: the normals of its triangles
    std::vector<Box> leaf_boxes;            ///< for each leaf: the box of all its triangles
    std::vector<std::uint8_t> is_changed;   ///< whether each leaf changed since the last search
  };
  /// Returns the boxes of a mesh. All leaves count as changed.
  /// \param mesh  Positions, #V by 3.
  Boxes make_boxes(const Positions& mesh) const;
  /// Updates the boxes after vertices moved.
  ///
  /// \param changed  Whether each vertex moved since the last update.
  void update(const Positions& mesh, const std::vector<bool>& changed, Boxes& boxes) const;

  /// Returns the intersecting pairs with at least one triangle in a changed leaf, ascending.
  ///
  /// \param is_exempt  Returns whether a triangle is exempt. The search ignores pairs of two exempt
  ///                   triangles.
  std::vector<Pair> intersecting_pairs(const Positions& mesh, const Boxes& boxes,
                                       const std::function<bool(std::uint32_t)>& is_exempt) const;

 private:
  /// The candidate pairs between two leaves (or within one leaf, if both are equal), as bit masks:
  /// bit 8·i + j stands for triangle i of the first leaf and triangle j of the second leaf.
  struct LeafPair {
    std::uint32_t first, second;       ///< indices of the two leaves
    std::uint64_t always_tested_mask;  ///< pairs of triangles that every search tests
    /// pairs of triangles that are a few edges apart, tested only if their normals differ
    std::uint64_t tested_if_normals_differ_mask;
  };
  /// Sets `leaf_pairs_`. The parameters are those of the constructor, except that `triangles`
  /// refers to rows of `points`, the positions of `vertices_`.
  void find_leaf_pairs(const std::vector<Triangle>& triangles, const Positions& points,
                       double max_distance, double max_facing_distance);
  /// Computes the boxes and normals of one leaf from `boxes.points`.
  void measure_leaf(std::size_t leaf, Boxes& boxes) const;

  std::vector<Triangle> triangles_;  ///< the triangles to search, with vertex indices of the mesh
  /// vertex indices of the mesh, ascending: the vertices of the triangles
  std::vector<std::uint32_t> vertices_;
  TriangleTree tree_;  ///< tree over `triangles_`; its vertex indices are rows of `vertices_`
  /// all pairs of leaves that have pairs of triangles to test; sorted by the indices of the leaves
  std::vector<LeafPair> leaf_pairs_;
};

}  // namespace crowdface
