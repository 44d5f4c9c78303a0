// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "crowdface/lod/detail_level.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// For each vertex of the whole mesh that is missing in a level: the nearest triangle of the level.
/// A walk along the surface of one head finds this triangle.
struct LevelMap {
  /// The vertices that faces of the whole mesh use but that are missing in the level, ascending.
  std::vector<std::uint32_t> vertices;
  /// #vertices: the nearest triangle, as indices of the level's vertices
  std::vector<Triangle> triangles;
};
/// Finds the triangles of a LevelMap.
/// \param typical  #V by 3: the head on which distances are measured.
LevelMap find_level_triangles(const Topology& whole, const Adjacency& adjacency,
                              const DetailLevel& level, const Positions& typical);

/// Returns the error over all meshes together, in their unit. The error is an upper bound, because
/// on some mesh a triangle other than the mapped one may be nearer. If a vertex is far from its
/// mapped triangle, neighbouring triangles are searched too.
/// \param meshes  each #V by 3, at least one.
LevelError level_error(const DetailLevel& level, const LevelMap& map,
                       std::span<const Positions* const> meshes);

}  // namespace crowdface
