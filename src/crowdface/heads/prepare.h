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
#include "crowdface/heads/head_cache.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/heads/kept_patches.h"
#include "crowdface/smooth/chebyshev_filter.h"

namespace crowdface {

/// All heads, ready for casting and blending.
struct Prepared {
  FaceSamples samples;
  FaceSamples traced;  ///< the samples, and after them what their mirror images are made of besides
  std::vector<Trajectory> trajectories;     ///< #heads, of what is traced
  std::vector<StoredLevels> levels;         ///< #heads; without fields with `levels: exact`
  std::shared_ptr<const LevelNodes> nodes;  ///< that `mixing` refers to
  KeptPatches patches;                      ///< of all heads' fields, unless `levels: exact`
  std::optional<ChebyshevFilter> filter;    ///< `levels: exact`
  std::size_t from_cache = 0;               ///< how many heads the cache had
};

/// An entry of the cache was cut while its fields were in use: what was made of them is worth
/// nothing, and what is prepared again is whole.
struct CutWhileInUse : IoError {
  using IoError::IoError;
};

/// To be asked after fields were used, before what came of it is. \throws CutWhileInUse.
void require_whole(const Prepared& prepared);

/// Prepares every head, one after the other, or takes it from the cache. A damaged cache entry is
/// made anew with a warning; a cache that cannot be written costs a warning, not the run.
/// \param cache  the cache's folder, see cache_directory.
Prepared prepare(const Config& config, const Inputs& inputs, const SmoothingOperator& smoothing,
                 const CacheFolder& cache);

/// Into the cache only: heads that it has not. \param is_wanted  of a head's place, from 0.
/// \throws CannotCreate, IoError if a head cannot be kept.
void prepare_some(const Config& config, const Inputs& inputs, const SmoothingOperator& smoothing,
                  const CacheFolder& cache, const std::function<bool(std::size_t)>& is_wanted);

/// The fitted levels in the form that blending takes.
std::vector<HeadLevels> head_levels(const Config& config, const Prepared& prepared);

/// Does the work again, and says so, when an entry of the cache was cut while it was in use: prepared
/// anew it is whole, and what was done before counts as done.
template <class Work>
void going_on_if_cut(const Work& work) {
  constexpr int kMostTimes = 3;
  for (int times = 1;; ++times) {
    try {
      return work();
    } catch (const CutWhileInUse& error) {
      if (times == kMostTimes) throw;
      log_warning(concat(error.what(), "; it is made anew, and the run goes on"));
    }
  }
}

}  // namespace crowdface
