// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface::testing {

/// Pairs of faces without a common vertex that cut through each other. Polygons are taken as fans
/// of triangles around their first corner; faces that only touch may or may not count.
/// \param cell  side of the search grid's cells: a few edges long.
std::vector<std::pair<Index, Index>> find_self_crossings(const Topology& topology,
                                                         const Positions& positions, double cell);

}  // namespace crowdface::testing
