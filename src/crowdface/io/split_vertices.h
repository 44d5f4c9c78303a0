// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A topology for formats where a vertex has one texture coordinate and faces are triangles. The
/// first #V split vertices are the original ones in their order, each with the texture coordinate
/// that its first corner has; further ones that a vertex has at other corners follow, in the order
/// of the corners. Depends on the topology alone.
struct SplitVertices {
  std::vector<std::uint32_t> vertices;  ///< #S, the original vertex of each; i itself for i < #V
  std::vector<std::uint32_t> uvs;       ///< #S, rows of the UVs or kNoIndex; empty if none has any
  /// Face by face, corner by corner: polygons as fans from their first corner.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> triangle_faces;  ///< the face each triangle is from
};

SplitVertices split_vertices(const Topology& topology);

}  // namespace crowdface
