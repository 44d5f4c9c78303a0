// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/cached_statistics.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "crowdface/core/parallel.h"
#include "crowdface/core/result_versions.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/cached.h"

namespace crowdface {
namespace {

Digest digest_of_map(const TextureMap& map) {
  Hasher hasher;
  hasher.add(map.width).add(map.height).add(static_cast<int>(map.coding.content));
  hasher.add(map.coding.channels).add(static_cast<double>(map.coding.low));
  hasher.add(static_cast<double>(map.coding.step)).add_array(map.stored());
  return hasher.digest();
}

constexpr auto kStatisticsArrays = [](auto& arrays, auto& statistics) {
  arrays("covariances", statistics.covariances);
  for (std::size_t h = 0; h < statistics.coarse_values.size(); ++h) {
    arrays(concat("coarse ", h), statistics.coarse_values[h]);
  }
};

}  // namespace

Digest statistics_key(const Digest& row_order, const Topology& topology,
                      const TextureCoordinates& uvs, const CrowdTextures& textures,
                      const StatisticsScale& scale) {
  std::vector<const TextureMap*> maps;
  for (const auto& of_picture : textures.maps) {
    for (const auto& map : of_picture) maps.push_back(map.get());
  }
  std::vector<Digest> digests(maps.size());
  parallel_for_each(maps.size(), [&](std::size_t m) {
    if (maps[m] != nullptr) digests[m] = digest_of_map(*maps[m]);
  });
  Hasher hasher;
  hasher.add(kTextureVersion).add(row_order);
  hasher.add_array(std::span(topology.corner_uvs));
  hasher.add_array(std::span(uvs.data(), static_cast<std::size_t>(uvs.size())));
  hasher.add_array(std::span(textures.layout.picture_of_polygon));
  for (const TextureLayout::Picture& picture : textures.layout.pictures) {
    hasher.add(picture.width).add(picture.height);
  }
  hasher.add(scale.detail_iterations).add(scale.covariance_iterations).add(textures.maps.size());
  for (const Digest& digest : digests) hasher.add(digest);
  return hasher.digest();
}

SurfaceStatistics cached_statistics(const CacheFolder& cache, const Digest& key,
                                    std::size_t vertices, std::size_t heads,
                                    const std::function<SurfaceStatistics()>& make) {
  SurfaceStatistics room;
  room.coarse_values.resize(heads);
  room.pair_count = heads * (heads + 1) / 2;
  return read_or_make(
      cache, {"texture-statistics", key}, make, kStatisticsArrays,
      [&](const SurfaceStatistics& found, const CacheEntry&) {
        const auto has_all = [&](const SurfaceStatistics::Colours& colours) {
          return colours.rows() == static_cast<Index>(vertices);
        };
        return std::ranges::all_of(found.coarse_values, has_all) &&
               found.covariances.size() == vertices * found.pair_count;
      },
      std::move(room));
}

}  // namespace crowdface
