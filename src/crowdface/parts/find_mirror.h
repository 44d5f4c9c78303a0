// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/mirror_map.h"

namespace crowdface {

/// The other side of each vertex, and how well it was found.
struct FoundMirror {
  MirrorMap map;
  Index vertices = 0;    ///< whose place is a vertex, which has them for its own
  Index on_surface = 0;  ///< whose place is another on the surface; all that are left have none
  /// How far the mean head is from its mirror image where there are places, in its unit.
  double rms = 0, largest = 0;

  /// Of all vertices.
  double share() const;
};

/// Finds the plane in which the mean head is most nearly its own mirror image, the coordinate plane where
/// that does nearly as well, and the other side of each vertex. Components answer to those that lie where
/// their image does: eyes to eyes. Where two have the same faces, mirrored, that tells the partners,
/// however far left and right of the mean head differ; elsewhere two vertices are partners that are
/// nearest to each other's image and near it, and all others get the nearest place on the surface.
/// \param mean  #V by 3
/// \param side  unit vector from the head's right to its left, or the other way
FoundMirror find_mirror(const Topology& topology, const Components& components,
                        const Positions& mean, const Eigen::Vector3d& side);

}  // namespace crowdface
