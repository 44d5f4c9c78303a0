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
#include "crowdface/shapes/skin_over_parts.h"
#include "crowdface/shapes/touching_skin.h"

namespace crowdface {

/// Removes self-intersections that a shape causes on a face but not on the template: in folds,
/// between lips, and where eyelids meet. Only displacements near intersections change.
class SkinCrossings {
 public:
  SkinCrossings() = default;
  /// \param skin    Vertices of the skin, ascending.
  /// \param extent  Diagonal of the skin's bounding box; the faces have about the same extent as
  ///                the template.
  SkinCrossings(const Topology& topology, std::span<const std::uint32_t> skin, double extent,
                const HeadAxes& axes);

  /// Returns all triangles of the skin.
  const SkinTriangles& mesh() const { return skin_; }

  /// The skin in which one shape may cause intersections of the skin with itself, see
  /// skin_that_may_touch.
  struct SearchedSkin {
    CrossingSearch search;  ///< searches the triangles of the skin that may touch other skin
    /// for each triangle of `search`: whether the triangle is at an intersection that the template,
    /// or a head, already has in this shape. Intersections between two of these triangles are
    /// ignored on faces.
    std::vector<bool> may_intersect;
    /// For each vertex: 1 on the upper lid and −1 on the lower lid of an eye that the shape closes;
    /// 0 on all other skin. Empty if the shape closes no eye.
    std::vector<signed char> lid_sides;
    /// the rows of the shape's displacements whose vertices are skin
    std::vector<DisplacementRow> skin_displacements;
    /// #skin_displacements by 3: positions of the vertices of `skin_displacements` on the template
    /// with the shape applied
    Positions shaped_positions;
    /// Whether the shape brings skin together that is far apart at rest. If so, intersecting skin
    /// gets the same front-to-back order as on the template.
    bool brings_distant_skin_together = false;
  };
  /// Finds the skin in which to search for intersections of a shape.
  /// \param neutral  The mesh to which the shape is added, #V by 3.
  /// \param lid_sides     See SearchedSkin::lid_sides.
  SearchedSkin find_searched_skin(const Positions& neutral, const Displacements& shape,
                                  std::vector<signed char> lid_sides) const;
  /// Sets `may_intersect` for every triangle that intersects another triangle of `mesh`, or that
  /// shares a vertex with an intersecting triangle. NewIntersections ignores the same triangles.
  void allow_intersections_of(const Positions& mesh, SearchedSkin& searched_skin) const;

  /// Returns one search over all triangles of the given searches.
  ///
  /// \param neutral  Template at rest, #V by 3.
  CrossingSearch merge_searches(const Positions& neutral,
                                std::span<const CrossingSearch* const> searches) const;
  /// Returns, for each vertex, whether it belongs to an intersecting triangle of a face at rest.
  std::vector<bool> crossing_at_rest(const Positions& rest, const CrossingSearch& search) const;

  /// A face at rest, to which a shape is added.
  struct Face {
    const Positions& rest;  ///< #V by 3: the mesh to which the shape is added
    /// for each vertex: whether the vertex belongs to an intersecting triangle of the face at rest,
    /// see crossing_at_rest
    const std::vector<bool>& crosses_at_rest;
    const RigidMotion& face_motion;  ///< motion from the template to the face
  };
  /// Returns the number of intersecting triangles in a shape of a face.
  ///
  /// \param mesh  Equal to `face.rest`; modified during the call and restored.
  Index count_intersecting(const Face& face, const SearchedSkin& searched_skin,
                           const Displacements& shape, Positions& mesh) const;

  /// A function that returns a cost of a shape's displacements, `moves`. This cost does not depend
  /// on intersections.
  using ExtraCost = std::function<double(const Positions& moves)>;
  /// Removes intersections from a shape of a face, in several rounds. Around intersections,
  /// displacements are averaged over skin that is close together at rest, so that the skin keeps
  /// its front-to-back order. Eyelids are pushed apart, or get the front-to-back order of the
  /// template's lids. The result is the round with the lowest cost: the number of intersecting
  /// triangles plus `extra_cost`.
  ///
  /// \param mesh   Equal to `face.rest`; modified during the call and restored.
  /// \param shape  Displacements of the face; adjusted.
  /// \param extra_cost  Additional cost of the displacements; 1 is the cost of one intersecting
  ///                    triangle.
  /// \return       Number of triangles that still intersect other triangles.
  Index repair(const Face& face, const SearchedSkin& searched_skin, Positions& mesh,
               Displacements& shape, const ExtraCost& extra_cost = {}) const;

 private:
  class Repair;

  double extent_ = 0;
  HeadAxes axes_;
  std::vector<bool> is_skin_;  ///< whether each vertex is skin
  SkinTriangles skin_;
};

}  // namespace crowdface
