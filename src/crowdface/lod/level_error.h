// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "crowdface/lod/detail_level.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// For each vertex of the whole mesh that a level does not contain: the level's triangle that is
/// nearest to the vertex. This triangle is found by a walk along the surface of one head.
struct NearestLevelTriangles {
  /// The vertices that polygons of the whole mesh use but that the level does not contain,
  /// ascending.
  std::vector<std::uint32_t> vertices;
  /// for each of the `vertices`, the nearest triangle, as indices of the level's vertices
  std::vector<Triangle> triangles;
};
/// Finds the nearest triangle of the level for each vertex that the level does not contain.
///
/// \param typical_positions  #V by 3: the head on which the distances are measured.
NearestLevelTriangles find_level_triangles(const Topology& whole, const Adjacency& adjacency,
                                           const DetailLevel& level,
                                           const Positions& typical_positions);

/// Returns the error over all meshes together, in the unit of their positions. The error is an
/// upper bound, because on some meshes another triangle may be nearer to a vertex than its mapped
/// triangle. If a vertex is far from its mapped triangle, the function also searches neighbouring
/// triangles.
///
/// \param meshes  each #V by 3, at least one.
LevelError level_error(const DetailLevel& level, const NearestLevelTriangles& map,
                       std::span<const Positions* const> meshes);

}  // namespace crowdface
