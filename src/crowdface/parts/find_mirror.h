// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/mirror_map.h"

namespace crowdface {

/// The mirror partner of each vertex, and the quality of the match.
struct FoundMirror {
  MirrorMap map;
  /// number of vertices that have a mutual partner: a vertex v counts if its partner is a vertex
  /// whose partner is v
  Index paired_vertex_count = 0;
  /// number of vertices whose partner is a point inside a polygon or on an edge, not a vertex.
  /// Vertices that belong to neither this count nor paired_vertex_count have no partner.
  Index surface_mirrored_vertex_count = 0;
  /// Distance of the mean head from its mirror image, in the unit of the heads: root mean square
  /// and maximum over all vertices.
  double rms_distance = 0, max_distance = 0;

  /// Returns the fraction of vertices that have a partner.
  double partner_fraction() const;
};

/// Finds the symmetry plane of the mean head and the partner of each vertex. A coordinate plane is
/// preferred if it fits nearly as well as the best plane.
///
/// Components are matched by position: the left eye with the right eye. If the polygons of two
/// matched components mirror each other, a walk over the polygons gives the partners, however
/// asymmetric the mean head is. Otherwise, vertices v and w are partners if w is the vertex nearest
/// to the mirror image of v and close to this image, and v is the vertex nearest to the mirror
/// image of w. The partner of every other vertex is the point of the surface that is nearest to the
/// mirror image of the vertex.
///
/// \param mean  Positions of the mean head, #V by 3.
/// \param side  Unit vector along the head's side axis: towards the left or the right ear.
FoundMirror find_mirror(const Topology& topology, const Components& components,
                        const Positions& mean, const Eigen::Vector3d& side);

}  // namespace crowdface
