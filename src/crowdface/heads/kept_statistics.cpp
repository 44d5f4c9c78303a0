// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/kept_statistics.h"

#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "crowdface/core/parallel.h"
#include "crowdface/core/result_versions.h"
#include "crowdface/heads/kept_lists.h"

namespace crowdface {
namespace {

/// Numbers without detail, of one head after the other; covariances.
using Lists = std::tuple<std::vector<float>, std::vector<float>>;

Digest digest_of_map(const TextureMap& map) {
  Hasher hasher;
  hasher.add(map.width).add(map.height).add(static_cast<int>(map.coding.content));
  hasher.add(map.coding.channels).add(static_cast<double>(map.coding.low));
  hasher.add(static_cast<double>(map.coding.step)).add_array(map.stored());
  return hasher.digest();
}

Lists lists_of(SurfaceStatistics statistics) {
  Lists lists;
  auto& [coarse, covariances] = lists;
  for (const SurfaceStatistics::Colours& of_head : statistics.coarse) {
    coarse.insert(coarse.end(), of_head.data(), of_head.data() + of_head.size());
  }
  covariances = std::move(statistics.covariances);
  return lists;
}

}  // namespace

Digest statistics_key(const Digest& rows, const Topology& topology, const TextureCoordinates& uvs,
                      const CrowdTextures& textures, const StatisticsScale& scale) {
  std::vector<const TextureMap*> maps;
  for (const auto& of_picture : textures.maps) {
    for (const auto& map : of_picture) maps.push_back(map.get());
  }
  std::vector<Digest> digests(maps.size());
  parallel_for_each(maps.size(), [&](std::size_t m) {
    if (maps[m] != nullptr) digests[m] = digest_of_map(*maps[m]);
  });
  Hasher hasher;
  hasher.add(kTextureVersion).add("texture statistics").add(rows);
  hasher.add_array(std::span(topology.corner_uvs));
  hasher.add_array(std::span(uvs.data(), static_cast<std::size_t>(uvs.size())));
  hasher.add_array(std::span(textures.layout.of_face));
  for (const TextureLayout::Picture& picture : textures.layout.pictures) {
    hasher.add(picture.width).add(picture.height);
  }
  hasher.add(scale.detail).add(scale.strength).add(textures.maps.size());
  for (const Digest& digest : digests) hasher.add(digest);
  return hasher.digest();
}

SurfaceStatistics kept_statistics(const std::filesystem::path& cache, const Digest& key,
                                  std::size_t vertices, std::size_t heads,
                                  const std::function<SurfaceStatistics()>& make) {
  SurfaceStatistics statistics;
  statistics.pairs = heads * (heads + 1) / 2;
  auto [coarse, covariances] = kept_lists<float, float>(
      cache, key, [&] { return lists_of(make()); },
      [&](const std::vector<float>& of_heads, const std::vector<float>& of_pairs) {
        return of_heads.size() == heads * vertices * 3 &&
               of_pairs.size() == vertices * statistics.pairs && all_finite(of_heads) &&
               all_finite(of_pairs);
      });
  for (std::size_t h = 0; h < heads; ++h) {
    statistics.coarse.emplace_back(Eigen::Map<const SurfaceStatistics::Colours>(
        coarse.data() + h * vertices * 3, static_cast<Index>(vertices), 3));
  }
  statistics.covariances = std::move(covariances);
  return statistics;
}

}  // namespace crowdface
