// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "crowdface/validity/triangle_tree.h"

namespace crowdface {

/// Finds intersecting triangles in many meshes of one topology. The triangles are stored in leaves
/// of eight that are close together. The constructor determines on one mesh which leaves, and which
/// of their triangles, can intersect at all. Each search then only compares bounding boxes of these
/// candidates before the exact test.
class CrossingSearch {
 public:
  using Pair = std::array<std::uint32_t, 2>;  ///< indices of two triangles, ascending

  CrossingSearch() = default;
  /// \param triangles  The triangles to search.
  /// \param mesh       #V by 3. The mesh on which candidate pairs are determined.
  /// \param reach      Largest distance of two candidates on `mesh`.
  /// \param facing     Largest distance of two candidates that face each other; at least `reach`.
  ///
  /// If two triangles are only a few edges apart on one sheet, the pair is tested only where the
  /// normals of the triangles differ, that is, where the sheet is folded.
  CrossingSearch(std::vector<Triangle> triangles, const Positions& mesh, double reach,
                 double facing);

  const std::vector<Triangle>& triangles() const { return triangles_; }

  /// Bounding boxes of one mesh, kept from one search to the next.
  struct Boxes {
    SingleRows points;                 ///< #vertices of the triangles by 3
    std::vector<LeafBoxes> triangles;  ///< #leaves
    std::vector<LeafNormals> normals;  ///< #leaves
    std::vector<Box> leaves;
    std::vector<std::uint8_t> is_new;  ///< #leaves: whether the leaf changed since the last search
  };
  Boxes boxes_of(const Positions& mesh) const;
  /// Updates the boxes after vertices moved.
  ///
  /// \param changed  #V: whether a vertex moved since the last update.
  void renew(const Positions& mesh, const std::vector<bool>& changed, Boxes& boxes) const;

  /// Returns the intersecting pairs with at least one triangle in a changed leaf, ascending.
  ///
  /// \param excused  Returns whether a triangle is excused. A pair is ignored if both of its
  ///                 triangles are excused.
  std::vector<Pair> crossing(const Positions& mesh, const Boxes& boxes,
                             const std::function<bool(std::uint32_t)>& excused) const;

 private:
  /// Candidates in a pair of leaves (or in one leaf, paired with itself). Bit 8·i + j stands for
  /// triangle i of the first leaf and triangle j of the second.
  struct Near {
    std::uint32_t one, other;
    std::uint64_t always;
    /// pairs on one sheet, few edges apart: tested only if their normals differ
    std::uint64_t folded;
  };
  void find_near(const std::vector<Triangle>& numbered, const Positions& points, double reach,
                 double facing);
  void measure(std::size_t leaf, Boxes& boxes) const;

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> vertices_;  ///< vertices of the triangles, ascending
  TriangleTree tree_;                    ///< indexes vertices by their position in `vertices_`
  std::vector<Near> near_;               ///< ascending
};

}  // namespace crowdface
