// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Two vertices of the skin that face each other across a narrow gap, as on two lips.
struct FacingPair {
  /// Vertex indices: the vertex on one side of the gap (the "low" side) and the vertex on the other
  /// side (the "high" side).
  std::uint32_t low_vertex = 0, high_vertex = 0;
  Eigen::Vector3d middle;  ///< midpoint of the two vertices
  Eigen::Vector3d up;      ///< unit vector from the low side of the gap to its high side
};

/// Facing pairs of one gap, such as the pairs of a closed mouth. The low vertices of all pairs lie
/// on the same side of the gap.
using FacingGroup = std::vector<FacingPair>;

/// Finds where skin nearly touches skin. The distance between the two vertices of a pair is below
/// about a hundredth of the skin's extent, and their normals are opposite. The gap between the two
/// vertices is outside the head. Along the surface, the two vertices are at least three times as
/// far apart as in space. A closed mouth gives one group; nostrils and open eyes give no group.
///
/// \param positions  #V by 3; preferably the mean head.
/// \param skin       The skin's vertices, ascending; at least one. A dense skin is subsampled
///                   evenly.
std::vector<FacingGroup> find_facing_skin(const Topology& topology, const Adjacency& adjacency,
                                          const Positions& positions,
                                          std::span<const std::uint32_t> skin);

}  // namespace crowdface
