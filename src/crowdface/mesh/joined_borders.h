// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// The vertices of a mesh after its seams are closed.
struct JoinedBorders {
  std::vector<std::uint32_t> joined;  ///< #V: the joined vertex of each vertex
  std::vector<std::uint32_t> first;   ///< the first vertex of each joined vertex, ascending
};

/// Joins vertices that have the same position and lie on border edges, as the copies do that an
/// export makes at seams. Inner vertices that touch, such as those of closed lips, stay apart.
/// \param pieces  #V: only vertices with the same value are joined; empty: all vertices
JoinedBorders joined_borders(const Topology& topology, const Positions& positions,
                             const std::vector<std::uint32_t>& pieces = {});

}  // namespace crowdface
