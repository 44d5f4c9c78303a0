// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "crowdface/cast/face_samples.h"
#include "crowdface/smooth/chebyshev_filter.h"
#include "crowdface/smooth/level_basis.h"

namespace crowdface {

/// Fitted levels of one head, as they are kept. The fields may lie in a mapped file of the cache,
/// so that they cost no memory of ours.
struct StoredLevels {
  Index rank = 0;
  std::span<const float> fields;      ///< rank times #V by 3: all of c_0, then all of c_1, …
  std::shared_ptr<const void> owner;  ///< of the fields
  bool mapped = false;                ///< the fields lie in a file, not in memory of ours
  Eigen::MatrixXd mixing;             ///< `levels: basis`: #nodes by rank, see LevelBasis
  BasisError error;                   ///< `levels: basis`
};

/// What is computed once per head and kept: how the samples move under smoothing and, unless the
/// levels are exact, the fitted levels.
struct PreparedHead {
  std::uint64_t max_level = 0;
  Trajectory trajectory;
  StoredLevels levels;
};

/// All heads, ready for casting and blending.
struct Prepared {
  FaceSamples samples;
  std::vector<Trajectory> trajectories;     ///< #heads
  std::vector<StoredLevels> levels;         ///< #heads; without fields with `levels: exact`
  std::shared_ptr<const LevelNodes> nodes;  ///< that `mixing` refers to
  std::optional<ChebyshevFilter> filter;    ///< `levels: exact`
  std::size_t from_cache = 0;               ///< how many heads the cache had
};

}  // namespace crowdface
