// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Matches the vertices of two meshes that differ in the order of their vertices and polygons. The
/// match is a graph isomorphism that preserves polygons and their orientation. The function refines
/// vertex labels ("colours") from the labels of the neighbours (Weisfeiler and Leman 1968), then
/// traverses each component polygon by polygon from a vertex with the rarest label. If a component
/// matches in several ways, as a symmetric sphere does, the function takes the match with the
/// smallest distances between positions.
/// The traversal does not cross edges that have more than two polygons.
/// \return for each vertex of `expected`, the matching vertex of `found`. Nothing if the graphs
///         differ.
std::optional<std::vector<std::uint32_t>> match_graphs(const Topology& expected,
                                                       const Positions& expected_positions,
                                                       const Topology& found,
                                                       const Positions& found_positions);

/// Whether two meshes have the same polygons, where vertex v of one mesh is vertex v of the other
/// mesh. The function ignores the order of the polygons. It also ignores how polygons are cut into
/// triangles: polygons that are cut along different diagonals count as the same.
bool has_same_polygons(const Topology& a, const Topology& b);

/// Cuts polygons into fans of triangles. All triangles of a quad share the quad's corner
/// `fan_corner`, counted from 0. All triangles of another polygon share the polygon's first corner.
Topology triangulated(const Topology& topology, std::uint32_t fan_corner);

}  // namespace crowdface
