// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "crowdface/mesh/displacements.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/shapes/crossing_search.h"
#include "crowdface/shapes/meeting_skin.h"
#include "crowdface/shapes/skin_over_parts.h"

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

  const SkinTriangles& mesh() const { return skin_; }

  /// Which skin of a shape is looked at: see skin_that_may_meet.
  struct Watched {
    CrossingSearch search;
    std::vector<bool> excused;  ///< #triangles of that: at crossings of the template's own
    std::vector<signed char>
        side;                    ///< #V: 1 upper and −1 lower lid of an eye that closes; or empty
    std::vector<ShapeRow> rows;  ///< that are skin
    Positions shaped;            ///< #rows by 3, of the template in the shape
    /// Skin that is far from each other at rest meets in it: it is laid as the template's lies.
    bool comes_from_afar = false;
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

  struct Face {
    const Positions& rest;  ///< #V by 3: what shapes are added to
    const std::vector<bool>&
        at_rest;               ///< #V, see crossing_at_rest; those crossings are none of a shape's
    const RigidMotion& whole;  ///< from the template
  };
  /// How many triangles pass through others in a shape of a face.
  /// \param mesh  the face at rest; changed while it works
  Index count(const Face& face, const Watched& watched, const Displacements& shape,
              Positions& mesh) const;

  using Harm = std::function<double(const Positions& moves)>;
  /// Makes a shape fit: displacements around crossings are evened out over what is near each other at rest, so
  /// that it stays as it lies there; lids are pushed off each other, or laid as the template's lie.
  /// \param mesh     the face at rest; changed while it works
  /// \param shape    of the face
  /// \param harm     of displacements, beside crossings, in triangles: the best of all rounds is kept; none: the
  ///                 last is
  /// \return         how many triangles still pass through others
  Index mend(const Face& face, const Watched& watched, Positions& mesh, Displacements& shape,
             const Harm& harm = {}) const;

 private:
  class Mending;

  double extent_ = 0;
  HeadAxes axes_;
  std::vector<bool> is_skin_;  ///< #V
  SkinTriangles skin_;
};

}  // namespace crowdface
