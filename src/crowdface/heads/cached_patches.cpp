// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/cached_patches.h"

#include <optional>
#include <utility>

#include "crowdface/heads/cached.h"

namespace crowdface {

namespace {

constexpr auto kPatchArrays = [](auto& arrays, auto& lists) {
  arrays("weights", lists.weights);
  arrays("vertices", lists.vertices);
  arrays("skeletons", lists.stored_vertex_counts);
  arrays("counts", lists.field_counts);
  arrays("steps", lists.quantization_steps);
  arrays("numbers", lists.quantized_values);
};

}  // namespace

CachedPatches cached_patches(const CacheFolder& cache, const Digest& key, Index vertex_count,
                             std::span<const Index> ranks,
                             const std::function<FieldPatches()>& make) {
  const CacheKey entry_key{"patches", key};
  const auto in_file = [&] {
    CachedPatches kept;
    const bool path_exists =
        find_cached<PatchArrays>(cache, entry_key, kPatchArrays,
                                 [&](PatchArrays& lists, const CacheEntry& entry) {
                                   lists.memory_owner = kept.mapped_file = entry.file();
                                   auto patches =
                                       FieldPatches::from_arrays(lists, vertex_count, ranks);
                                   if (!patches) return false;
                                   kept.patches = *std::move(patches);
                                   return true;
                                 })
            .has_value();
    return path_exists ? std::optional(std::move(kept)) : std::nullopt;
  };
  if (auto found = in_file()) return *std::move(found);
  FieldPatches made = make();
  if (store(cache, entry_key, arrays_of(made.arrays(), kPatchArrays))) {
    // use the mapped file, so that the patches do not stay in memory twice
    if (auto found = in_file()) return *std::move(found);
  }
  return {std::move(made), nullptr};
}

}  // namespace crowdface
