// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "crowdface/core/hash.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/texture/surface_statistics.h"

namespace crowdface {

/// Hash of everything that the statistics of the heads' maps depend on.
/// \param row_order  hash of the topology's vertices and polygons, and of the positions that
///              determine the filter's row order
Digest statistics_key(const Digest& row_order, const Topology& topology,
                      const TextureCoordinates& uvs, const CrowdTextures& textures,
                      const StatisticsScale& scale);

/// Returns the statistics from the cache. If the cache lacks the statistics, calls `make()` and
/// stores the result.
/// \param vertices  number of vertices of the mesh
/// \param heads     number of heads
SurfaceStatistics cached_statistics(const CacheFolder& cache, const Digest& key,
                                    std::size_t vertices, std::size_t heads,
                                    const std::function<SurfaceStatistics()>& make);

}  // namespace crowdface
