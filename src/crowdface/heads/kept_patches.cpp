// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/kept_patches.h"

#include <utility>

#include "crowdface/heads/cached.h"

namespace crowdface {

KeptPatches kept_patches(const CacheFolder& cache, const Digest& key, Index vertex_count,
                         std::span<const Index> ranks, const std::function<FieldPatches()>& make) {
  const CacheKey entry_key{"patches", key};
  const auto in_file = [&](const CacheEntry& entry) {
    auto patches = FieldPatches::of({.vertices = entry.get<std::uint32_t>("vertices"),
                                     .skeletons = entry.get<std::uint32_t>("skeletons"),
                                     .counts = entry.get<std::uint32_t>("counts"),
                                     .steps = entry.get<float>("steps"),
                                     .weights = entry.get<float>("weights"),
                                     .numbers = entry.get<std::int16_t>("numbers"),
                                     .owner = entry.file()},
                                    vertex_count, ranks);
    entry.require(patches.has_value());
    return KeptPatches{*std::move(patches), entry.file()};
  };
  if (auto found = find_cached(cache, entry_key, in_file)) return *std::move(found);
  FieldPatches made = make();
  const PatchLists& lists = made.lists();
  const bool kept = store(cache, entry_key,
                          {array_of("weights", lists.weights), array_of("vertices", lists.vertices),
                           array_of("skeletons", lists.skeletons), array_of("counts", lists.counts),
                           array_of("steps", lists.steps), array_of("numbers", lists.numbers)});
  if (kept) {  // used from there from now on: memory holds them once
    if (auto found = find_cached(cache, entry_key, in_file)) return *std::move(found);
  }
  return {std::move(made), nullptr};
}

}  // namespace crowdface
