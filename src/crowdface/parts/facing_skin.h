// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Two places of skin that look at each other through a narrow gap, like the two lips.
struct FacingPair {
  std::uint32_t low = 0, high = 0;  ///< vertices
  Eigen::Vector3d middle;           ///< between them
  Eigen::Vector3d up;               ///< unit: from the low side to the high one
};

/// Pairs near each other; all of them have their low sides on one side.
using FacingGroup = std::vector<FacingPair>;

/// Where skin nearly touches skin: vertices nearer to each other than a hundredth of the skin's extent or so,
/// whose normals are opposed, with air between them and not flesh, and at least three times as far
/// from each other along the surface. A closed mouth is one group; nostrils and open eyes are none.
/// \param positions  #V by 3, best those of the mean head.
/// \param skin       its vertices, ascending, at least one. Of many some stand for all, evenly spread.
std::vector<FacingGroup> find_facing_skin(const Topology& topology, const Adjacency& adjacency,
                                          const Positions& positions,
                                          std::span<const std::uint32_t> skin);

}  // namespace crowdface
