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

/// Patches that may lie in a mapped file of the cache, so that they cost no memory of ours.
struct KeptPatches {
  FieldPatches patches;
  std::shared_ptr<const MappedFile> mapped;  ///< if they lie in a file
};

/// What `make()` returns, from the cache if it is there.
/// \param key    of all that the patches depend on
/// \param ranks  #heads: how many fields each has
KeptPatches kept_patches(const CacheFolder& cache, const Digest& key, Index vertex_count,
                         std::span<const Index> ranks, const std::function<FieldPatches()>& make);

}  // namespace crowdface
