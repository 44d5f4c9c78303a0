// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "crowdface/cast/face_samples.h"
#include "crowdface/job/config.h"
#include "crowdface/job/inputs.h"
#include "crowdface/smooth/cubic_fit.h"

namespace crowdface {

/// What is computed once per head and kept: how the samples move under smoothing and, with
/// `levels: cubic`, the fitted levels.
struct PreparedHead {
  std::uint64_t max_level = 0;
  Trajectory trajectory;
  std::optional<CubicFit> fit;
};

/// All heads, ready for casting and blending.
struct Prepared {
  FaceSamples samples;
  std::vector<Trajectory> trajectories;  ///< #heads
  std::vector<CubicFit> fits;            ///< #heads with `levels: cubic`, else empty
  std::size_t from_cache = 0;            ///< how many heads the cache had
};

/// Prepares every head, or takes it from the cache. A damaged cache entry is made anew with a
/// warning; a cache that cannot be written costs a warning, not the run.
/// \param cache  the cache's folder, see cache_directory.
Prepared prepare(const Config& config, const Inputs& inputs, const SmoothingOperator& smoothing,
                 const std::filesystem::path& cache);

}  // namespace crowdface
