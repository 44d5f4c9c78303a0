// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "crowdface/blend/crowd_blender.h"
#include "crowdface/cast/face_samples.h"
#include "crowdface/config/config.h"
#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/cached_patches.h"
#include "crowdface/heads/head_cache.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/smooth/chebyshev_filter.h"

namespace crowdface {

/// All heads, ready for casting and blending.
struct PreparedHeads {
  FaceSamples samples;  ///< the vertices at which faces are compared and judged
  /// The vertices whose smoothing trajectories are computed: the samples, then the other vertices
  /// on which the samples' mirror images depend.
  FaceSamples trajectory_samples;
  std::vector<Trajectory> trajectories;  ///< #heads: trajectories of `trajectory_samples`
  /// #heads: the fitted smoothing levels of each head; empty with `levels: exact`
  std::vector<StoredLevels> levels;
  /// the nodes to which the rows of StoredLevels::function_coefficients belong, for all heads
  std::shared_ptr<const LevelNodes> nodes;
  CachedPatches patches;  ///< fields of all heads, grouped by patches; empty with `levels: exact`
  std::optional<ChebyshevFilter> filter;  ///< the exact filter; nothing without `levels: exact`
  std::size_t cached_head_count = 0;      ///< number of heads found in the cache
};

/// Thrown if a cache entry was truncated while its fields were in use. Results computed from the
/// entry must be discarded. Preparing the heads again repairs the entry.
struct TruncatedWhileInUse : IoError {
  using IoError::IoError;
};

/// Checks that no cache entry was truncated while its fields were in use. Call this after using the
/// fields and before using the results.
/// \throws TruncatedWhileInUse.
void throw_if_truncated(const PreparedHeads& prepared);

/// Prepares all heads, or reads prepared heads from the cache. A damaged cache entry is computed
/// again with a warning; a cache that cannot be written only causes a warning.
/// \param cache  see cache_directory
PreparedHeads prepare(const Config& config, const Inputs& inputs,
                      const SmoothingOperator& smoothing, const CacheFolder& cache);

/// Prepares the wanted heads that the cache lacks, and stores them in the cache.
/// \param is_wanted  called with the index of a head; returns whether to prepare the head
/// \throws CannotCreate, IoError if a head cannot be stored.
void prepare_heads(const Config& config, const Inputs& inputs, const SmoothingOperator& smoothing,
                   const CacheFolder& cache, const std::function<bool(std::size_t)>& is_wanted);

/// The prepared smoothing of each head, in the form that blending needs.
std::vector<HeadSmoothing> head_smoothings(const Config& config, const PreparedHeads& prepared);

/// Calls `work`. If a cache entry was truncated while in use, warns and calls `work` again, at most
/// three times in all. `work` must prepare the heads anew and skip what it has already finished.
template <class Work>
void retry_if_truncated(const Work& work) {
  constexpr int kMaxTries = 3;
  for (int tries = 1;; ++tries) {
    try {
      return work();
    } catch (const TruncatedWhileInUse& error) {
      if (tries == kMaxTries) throw;
      log_warning(concat(error.what(), "; it is created again, and the run continues"));
    }
  }
}

}  // namespace crowdface
