// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A closed loop of edges: the indices of its vertices in the order of the loop, without repeating
/// the first vertex at the end.
using Rim = std::vector<std::uint32_t>;

/// The open rims of a mesh: closed loops of edges that belong to exactly one polygon. The rims are
/// sorted by the lowest vertex index of each rim. A rim that touches another rim at a vertex is
/// omitted, because it is not a simple loop.
std::vector<Rim> find_open_rims(const Topology& topology, const Adjacency& adjacency);

/// Returns the closed loop of the mesh edges whose ends are both among `vertices`; empty if these
/// edges do not form exactly one loop.
Rim rim_through(std::span<const std::uint32_t> vertices, const Adjacency& adjacency);

}  // namespace crowdface
