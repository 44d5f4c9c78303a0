// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A topology for formats with one texture coordinate per vertex and only triangles. The first #V
/// split vertices are the original vertices in order, each with the texture coordinate of its first
/// corner. Copies for further texture coordinates follow, in order of corners. Depends only on the
/// topology.
struct SplitVertices {
  std::vector<std::uint32_t> vertices;  ///< #S: original vertex; i itself for i < #V
  /// #S: row of the UVs or kNoIndex; empty if there are no UVs
  std::vector<std::uint32_t> uvs;
  /// Triangles of all polygons in order; each polygon is a fan around its first corner.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> triangle_faces;  ///< index of the polygon that contains each triangle
};

SplitVertices split_vertices(const Topology& topology);

}  // namespace crowdface
