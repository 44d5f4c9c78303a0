// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "crowdface/cast/face_samples.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/smooth/chebyshev_filter.h"
#include "crowdface/smooth/level_basis.h"

namespace crowdface {

/// Fitted levels of one head, as they are kept. The fields may lie in a mapped file of the cache,
/// so that they cost no memory of ours.
struct StoredLevels {
  LevelFields fields;
  std::shared_ptr<const MappedFile> mapped;  ///< of the fields, if they lie in a file
  Eigen::MatrixXd mixing;                    ///< `levels: basis`: #nodes by rank, see LevelBasis
  BasisError error;                          ///< `levels: basis`
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
  FaceSamples traced;  ///< the samples, and after them what their mirror images are made of besides
  std::vector<Trajectory> trajectories;     ///< #heads, of what is traced
  std::vector<StoredLevels> levels;         ///< #heads; without fields with `levels: exact`
  std::shared_ptr<const LevelNodes> nodes;  ///< that `mixing` refers to
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

}  // namespace crowdface
