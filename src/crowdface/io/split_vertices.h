// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A triangulated topology with copies of vertices, for formats that allow only triangles and one
/// texture coordinate per vertex. The first #V split vertices are the original vertices in order,
/// each with the texture coordinate of its first corner. Copies for further texture coordinates
/// follow, in order of corners. Depends only on the topology.
struct SplitVertices {
  /// The original vertex of each split vertex. For i < #V, vertices[i] is i.
  std::vector<std::uint32_t> vertices;
  /// for each split vertex, its row in the texture coordinates, or kNoIndex; empty if the mesh has
  /// no texture coordinates
  std::vector<std::uint32_t> uvs;
  /// Triangles of all polygons in order; each polygon is a fan around its first corner.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> triangle_faces;  ///< index of the polygon that contains each triangle
};

SplitVertices split_vertices(const Topology& topology);

}  // namespace crowdface
