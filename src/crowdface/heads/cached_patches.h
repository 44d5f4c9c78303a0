// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "crowdface/core/file.h"
#include "crowdface/core/hash.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/smooth/field_patches.h"

namespace crowdface {

/// The heads' fields, compressed patch by patch (see FieldPatches). The patches may lie in a
/// memory-mapped cache file, so that they use no memory of the process.
struct CachedPatches {
  FieldPatches patches;
  /// the file that holds the patches; null if they lie in memory
  std::shared_ptr<const MappedFile> mapped_file;
};

/// Returns the patches from the cache. If the cache lacks the patches, calls `make()` and stores
/// the result.
/// \param key    hash of everything that the patches depend on
/// \param ranks  the number of fields of each head
CachedPatches cached_patches(const CacheFolder& cache, const Digest& key, Index vertex_count,
                             std::span<const Index> ranks,
                             const std::function<FieldPatches()>& make);

}  // namespace crowdface
