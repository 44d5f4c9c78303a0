// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/attach/bend_nodes.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/edge_distances.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Moves a bending attachment when an expression moves the skin. Like SmoothBend, this class fits
/// the rotation, translation and scale of patches of skin, but the patches are smaller and contain
/// only skin that is near along the surface. So a moustache does not follow the lower lip, and a
/// lash follows its own lid.
///
/// Each point of the attachment follows a point of the skin, its root. The search for roots begins
/// where the attachment's mesh is nearest to the skin. Each further search starts at the root of a
/// neighbouring point of the attachment's mesh.
class ShapeBend {
 public:
  /// \param skin       Must outlive this object.
  /// \param adjacency  Adjacency of the skin's mesh.
  /// \param topology   Topology of the attachment.
  /// \param points     Positions of the attachment's vertices on the fitted mesh (the head to which
  ///                   the attachment was fitted), #P by 3.
  ShapeBend(const FittedSkin& skin, const Adjacency& adjacency, const Topology& topology,
            const Positions& points);

  /// Returns the displacements of the attachment in an expression. Points whose patches contain no
  /// moved skin are omitted.
  ///
  /// \param face   #V by 3, at rest.
  /// \param placed  #P by 3, the attachment on that face at rest.
  /// \param shape  Displacements of the face's vertices in the expression.
  Displacements shape_displacements(const Positions& face, const Positions& placed,
                                    const Displacements& shape) const;

  std::size_t memory_bytes() const { return nodes_.memory_bytes(); }

 private:
  /// The root of a patch is the skin point that the patch's node follows. Removes from `patch` the
  /// vertices that are farther from this root than `limit`, measured along the surface. Removes no
  /// vertices if too few would remain.
  /// \param along  distances of vertices from the root, along the surface
  static void remove_distant_vertices(const EdgeDistances& along, double limit,
                                      FittedSkin::Patch& patch);

  BendNodes nodes_;  ///< the nodes, and their weights in the motion of each point
};

}  // namespace crowdface
