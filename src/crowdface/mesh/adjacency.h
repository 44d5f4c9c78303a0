// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// The edge-neighbours (one-ring) of every vertex in ascending order, and the vertices on the
/// mesh's boundary. Opposite corners of a quad are not neighbours.
struct Adjacency : CompressedRows<std::uint32_t> {
  /// For each vertex, whether it is an end of an edge with exactly one polygon.
  std::vector<bool> boundary;

  Index vertex_count() const { return static_cast<Index>(group_count()); }
};

/// Finds the edge-neighbours of every vertex. An edge with three or more polygons also
/// makes its ends neighbours, and is not on the boundary. A polygon that names a vertex twice adds
/// no edge from the vertex to itself.
Adjacency build_adjacency(const Topology& topology);

/// The connected components of a mesh. Two vertices with a common edge are in the same component.
/// Components are numbered in the order of their first vertices. An isolated vertex is its own
/// component.
struct Components {
  std::vector<std::uint32_t> component_of_vertex;  ///< one per vertex: index of its component
  std::vector<std::uint32_t> sizes;                ///< number of vertices in each component
  /// Number of components.
  Index count() const { return static_cast<Index>(sizes.size()); }
  /// Index of the component that has the most vertices. On a head, this component is the skin.
  std::uint32_t largest() const;
};
/// Finds the connected components of the mesh that has this adjacency.
Components find_components(const Adjacency& adjacency);

/// Root mean square of the edge lengths of one component, in the unit of the positions; 0 if the
/// component has no edges.
double rms_edge_length(const Adjacency& adjacency, const Components& components,
                       std::uint32_t component, const Positions& positions);

}  // namespace crowdface
