// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// An edge from `from` to `to`, as a face runs through it.
struct DirectedEdge {
  std::uint32_t from, to;
};

/// Vertices that answer each other if faces are mirrored.
struct MirroredPair {
  std::uint32_t vertex, partner;
};

/// Goes from face to face on two sides of a mesh at once, the other way round on the second, for as long
/// as faces there have as many corners and vertices meet the same partners as before.
/// \param edge   of a face on the first side
/// \param other  its image, of a face on the second: runs from the partner of edge.to to that of edge.from
/// \return  all vertices that were met; nothing if the sides are not alike
std::optional<std::vector<MirroredPair>> walk_mirrored(const Topology& topology,
                                                       const FacesAround& around, DirectedEdge edge,
                                                       DirectedEdge other);

}  // namespace crowdface
