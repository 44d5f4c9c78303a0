// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "crowdface/validity/triangle_tree.h"

namespace crowdface {

/// Looks for triangles that pass through others, in one mesh after the other of the same topology. Triangles
/// stand in leaves of eight that lie together; which leaves may meet, and which of their triangles, is found once, on
/// one mesh. Of each mesh then only boxes are made and compared.
class CrossingSearch {
 public:
  using Pair = std::array<std::uint32_t, 2>;  ///< numbers of triangles, ascending

  CrossingSearch() = default;
  /// \param triangles  those that are looked at
  /// \param mesh       #V by 3, on which others' leaves are looked for
  /// \param reach      how near to each other they are there, if they may ever meet
  /// \param facing     the same of such as face each other, not less
  /// Triangles of one sheet, a few edges apart, are asked about where they do not face alike.
  CrossingSearch(std::vector<Triangle> triangles, const Positions& mesh, double reach,
                 double facing);

  const std::vector<Triangle>& triangles() const { return triangles_; }

  /// Of one mesh: what is kept between two looks at it.
  struct Boxes {
    SingleRows points;                 ///< #vertices of the triangles by 3
    std::vector<LeafBoxes> triangles;  ///< #leaves
    std::vector<LeafNormals> normals;  ///< #leaves
    std::vector<Box> leaves;
    std::vector<std::uint8_t> is_new;  ///< #leaves: since the last look
  };
  Boxes boxes_of(const Positions& mesh) const;
  /// \param changed  #V: vertices that moved since then
  void renew(const Positions& mesh, const std::vector<bool>& changed, Boxes& boxes) const;

  /// Pairs that pass through each other, ascending, of which one is new.
  /// \param excused  of a triangle; pairs of two such are left out
  std::vector<Pair> crossing(const Positions& mesh, const Boxes& boxes,
                             const std::function<bool(std::uint32_t)>& excused) const;

 private:
  /// Of two leaves, maybe of one with itself: bit 8 i + j says whether triangle i of the first is asked about with
  /// triangle j of the second.
  struct Near {
    std::uint32_t one, other;
    std::uint64_t always;
    std::uint64_t folded;  ///< if they do not face alike, being few edges apart
  };
  void find_near(const std::vector<Triangle>& numbered, const Positions& points, double reach,
                 double facing);
  void measure(std::size_t leaf, Boxes& boxes) const;

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> vertices_;  ///< of those, ascending
  TriangleTree tree_;                    ///< of the triangles, their vertices numbered by these
  std::vector<Near> near_;               ///< ascending
};

}  // namespace crowdface
