// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "crowdface/core/grouped.h"
#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/triangles.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/shapes/crossing_search.h"

namespace crowdface {

/// Skin that a shape takes through other skin on a face, where it does not on the template: in folds, between lips,
/// where lids meet. The face's displacements are changed there, and nowhere else.
class SkinCrossings {
 public:
  SkinCrossings() = default;
  /// \param skin    its vertices, ascending
  /// \param extent  of the skin, about the same in the template and all faces
  SkinCrossings(const Topology& topology, std::span<const std::uint32_t> skin, double extent,
                const HeadAxes& axes);

  /// A row of a shape's displacements that is skin.
  struct Row {
    std::uint32_t row, vertex;
  };
  /// Which skin of a shape is looked at: that which the shape brings, or may on a face bring, to other skin.
  struct Watched {
    CrossingSearch search;
    std::vector<bool> excused;  ///< #triangles of that: at crossings of the template's own
    std::vector<signed char>
        side;  ///< #V: 1 upper and −1 lower lid of an eye that closes; or empty
    std::vector<Row> rows;
    bool is_meant = false;  ///< its crossings are counted and left
  };
  /// \param neutral  of the template, #V by 3
  Watched watch(const Positions& neutral, const Displacements& shape,
                std::vector<signed char> side) const;
  /// Crossings in this mesh are to be found on faces as well.
  void excuse(const Positions& mesh, Watched& watched) const;

  /// What is watched in any of the shapes. \param neutral  of the template, #V by 3
  CrossingSearch watch_all(const Positions& neutral,
                           std::span<const CrossingSearch* const> shapes) const;
  /// #V: whether a vertex is one of triangles that pass through others in a face at rest.
  std::vector<bool> crossing_at_rest(const Positions& rest, const CrossingSearch& all) const;

  using Harm = std::function<double(const Positions& moves)>;
  /// Makes a shape fit: displacements around crossings are evened out over what is near each other at rest, so
  /// that it stays as it lies there; and lids are pushed off each other. Crossings of the face at rest are
  /// none of the shape's.
  /// \param rest     of the face, #V by 3
  /// \param at_rest  #V, see crossing_at_rest
  /// \param mesh     the same as `rest`; changed while it works
  /// \param shape    of the face
  /// \param harm     of displacements, beside crossings, in triangles: the best of all rounds is kept; none: the
  ///                 last is
  /// \return         how many triangles still pass through others
  Index mend(const Positions& rest, const std::vector<bool>& at_rest, const Watched& watched,
             Positions& mesh, Displacements& shape, const Harm& harm = {}) const;

 private:
  using Pair = CrossingSearch::Pair;
  using Excused = std::function<bool(std::uint32_t)>;

  /// \param pairs  that cross; those that are left, in the end
  void take_apart(const Positions& rest, const Watched& watched, const Excused& excused,
                  CrossingSearch::Boxes& boxes, std::vector<Pair>& pairs, Positions& mesh,
                  Displacements& shape, const Harm& harm) const;
  int side_of(const Watched& watched, std::uint32_t triangle) const;
  enum class Push { kForward, kApart };
  void push_apart(const std::vector<Pair>& pairs, const Watched& watched, const Positions& rest,
                  double by, Push how, Displacements& shape, std::vector<bool>& changed) const;
  void even_out(const std::vector<Pair>& pairs, const Watched& watched, const Positions& rest,
                double grown, Displacements& shape, std::vector<bool>& changed) const;

  double extent_ = 0;
  HeadAxes axes_;
  std::vector<std::uint32_t> skin_;
  std::vector<bool> is_skin_;  ///< #V
  std::vector<Triangle> triangles_;
  Grouped<std::uint32_t> around_;  ///< #V: triangles at each
};

}  // namespace crowdface
