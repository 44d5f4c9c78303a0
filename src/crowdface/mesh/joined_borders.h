// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// The vertices of a mesh after its seams are closed. All copies of a vertex become one joined
/// vertex.
struct JoinedBorders {
  /// for each vertex, the index of the joined vertex that the vertex becomes
  std::vector<std::uint32_t> joined_vertex_of_vertex;
  /// for each joined vertex, the lowest index of its copies; ascending
  std::vector<std::uint32_t> first_copy_of_joined_vertex;
};

/// Joins vertices that have the same position and lie on border edges. Exporters make such copies
/// at seams. Inner vertices that touch, such as the vertices of closed lips, stay separate.
/// \param piece_of_vertex  one value per vertex: only vertices with equal values are joined. If
///                         empty, all values count as equal.
JoinedBorders joined_borders(const Topology& topology, const Positions& positions,
                             const std::vector<std::uint32_t>& piece_of_vertex = {});

}  // namespace crowdface
