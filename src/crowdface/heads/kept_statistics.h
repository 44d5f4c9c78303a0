// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "crowdface/core/hash.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/texture/surface_statistics.h"

namespace crowdface {

/// Of all that the statistics of heads' maps depend on.
/// \param rows  digest of the topology's vertices and faces, and of the positions that give the filter its rows' order
Digest statistics_key(const Digest& rows, const Topology& topology, const TextureCoordinates& uvs,
                      const CrowdTextures& textures, const StatisticsScale& scale);

/// What `make()` returns, from the cache if it is there.
/// \param vertices  of the mesh
SurfaceStatistics kept_statistics(const CacheFolder& cache, const Digest& key, std::size_t vertices,
                                  std::size_t heads,
                                  const std::function<SurfaceStatistics()>& make);

}  // namespace crowdface
