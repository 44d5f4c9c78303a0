// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/attach/bend_places.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/edge_distances.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Moves what bends with the skin when a face's expression moves that: at places on the skin the best turn, shift
/// and scale of the skin around, as SmoothBend, but closer, and of skin alone that is near along the surface. A
/// moustache does not hear of the lower lip, and a lash goes with the lid that it grows on: where a point has its
/// root is looked for from its neighbour's on, beginning where the mesh lies nearest to the skin.
class ShapeBend {
 public:
  /// \param skin       must outlive this object.
  /// \param adjacency  of the skin's mesh.
  /// \param points     #P by 3, beside the fitted mesh.
  /// \param topology   of the points
  ShapeBend(const FittedSkin& skin, const Adjacency& adjacency, const Topology& topology,
            const Positions& points);

  /// \param face    #V by 3, at rest
  /// \param worn    #P by 3, on that face
  /// \param shape   of the face
  /// \return        of those points that hear of skin that the shape moves
  Displacements in_shape(const Positions& face, const Positions& worn,
                         const Displacements& shape) const;

  std::size_t memory_bytes() const { return places_.memory_bytes(); }

 private:
  static void keep_near(const EdgeDistances& along, double limit, FittedSkin::Patch& patch);

  BendPlaces places_;
};

}  // namespace crowdface
