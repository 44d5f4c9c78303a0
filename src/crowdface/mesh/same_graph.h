// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Matches the vertices of two meshes that differ in the order of their vertices and polygons. The
/// match is a graph isomorphism that preserves polygons and their orientation. The function refines
/// vertex colours from the colours of the neighbours (Weisfeiler and Leman 1968), then traverses
/// each component polygon by polygon from a vertex of the rarest colour. If a component matches in
/// several ways, as a symmetric sphere does, the function takes the match with the smallest
/// distances between positions.
/// \return #V, for each vertex of `expected` the matching vertex of `found`. Nothing if the graphs
///         differ or if an edge has more than two polygons.
std::optional<std::vector<std::uint32_t>> match_graphs(const Topology& expected,
                                                       const Positions& expected_positions,
                                                       const Topology& found,
                                                       const Positions& found_positions);

/// Cuts polygons into fans of triangles. All triangles of a quad share its corner number
/// `fan_corner`, counted from 0; the triangles of other polygons share the first corner.
Topology triangulated(const Topology& topology, std::uint32_t fan_corner);

}  // namespace crowdface
