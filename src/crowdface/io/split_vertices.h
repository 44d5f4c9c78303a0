// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A triangulated topology in which each vertex has one texture coordinate, for formats that
/// require this. A vertex with several texture coordinates is split into several vertices. The
/// first #V split vertices are the original vertices in order, each with the texture coordinate of
/// its first corner. Copies of vertices for further texture coordinates follow, in order of
/// corners.
struct SplitVertices {
  /// The original vertex of each split vertex. For i < #V, vertices[i] is i.
  std::vector<std::uint32_t> vertices;
  /// for each split vertex: a row of the texture coordinates, or kNoIndex; empty if the mesh has no
  /// texture coordinates
  std::vector<std::uint32_t> uvs;
  /// Triangles of all polygons in order, as indices of split vertices. Each polygon becomes a fan
  /// around its first corner.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> triangle_faces;  ///< for each triangle: the polygon that it is part of
};

/// Splits each vertex that has several texture coordinates, and triangulates the polygons of the
/// topology; see SplitVertices.
SplitVertices split_vertices(const Topology& topology);

}  // namespace crowdface
