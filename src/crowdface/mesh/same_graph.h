// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Finds the vertices of one mesh in another whose vertices and faces stand in another order: an isomorphism of their
/// graphs that keeps faces and the way round them. Colours of vertices are refined from those of their neighbours
/// (Weisfeiler and Leman 1968); then each component is walked face by face from a vertex of the rarest colour. Where
/// a component fits in several ways, as balls do, the nearest one counts.
/// \return #V, the vertex of `found` for each of `expected`; nothing if the graphs differ, or an edge has more than two
///         faces.
std::optional<std::vector<std::uint32_t>> same_graph(const Topology& expected,
                                                     const Positions& expected_positions,
                                                     const Topology& found,
                                                     const Positions& found_positions);

/// Polygons as triangles around their first corner, or around their second.
Topology triangulated(const Topology& topology, std::uint32_t around);

}  // namespace crowdface
