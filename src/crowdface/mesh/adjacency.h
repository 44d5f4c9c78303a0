// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// The edge-neighbours (one-ring) of every vertex, ascending, and where the surface is open.
/// Opposite corners of a quad are no neighbours.
struct Adjacency : Grouped<std::uint32_t> {
  std::vector<bool> boundary;  ///< #V: on an edge that has exactly one face

  Index vertex_count() const { return static_cast<Index>(group_count()); }
};

/// Edges with three or more faces are kept and are no boundary; a face that names a vertex twice
/// gives no edge from it to itself.
Adjacency build_adjacency(const Topology& topology);

/// The connected component of each vertex (vertices joined by edges), numbered by their first
/// vertex; an isolated vertex is a component of its own.
struct Components {
  std::vector<std::uint32_t> of_vertex;  ///< #V
  std::vector<std::uint32_t> sizes;      ///< vertices in each component
  Index count() const { return static_cast<Index>(sizes.size()); }
  /// The component with most vertices: the skin.
  std::uint32_t largest() const;
};
Components find_components(const Adjacency& adjacency);

/// Root of the mean squared length of the edges of one component, in the positions' unit; 0 if it
/// has none.
double rms_edge_length(const Adjacency& adjacency, const Components& components,
                       std::uint32_t component, const Positions& positions);

}  // namespace crowdface
