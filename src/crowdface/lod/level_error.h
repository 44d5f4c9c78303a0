// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "crowdface/lod/detail_level.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// For each vertex of the whole mesh that a level lacks, the level's triangle nearest to it on one head,
/// found by walking along the surface.
struct LevelMap {
  std::vector<std::uint32_t> vertices;  ///< of the whole mesh, ascending; only those that faces use
  std::vector<Triangle> triangles;      ///< #vertices, of the level's vertices
};
LevelMap map_to_level(const Topology& whole, const Adjacency& adjacency, const DetailLevel& level,
                      const Positions& typical);

/// Over all the meshes together, in their unit. Never too small: another triangle might be nearer than
/// the one that was found; where a vertex is far from that, those around are looked at too.
/// \param meshes  each #V by 3, at least one.
LevelError level_error(const DetailLevel& level, const LevelMap& map,
                       std::span<const Positions* const> meshes);

}  // namespace crowdface
