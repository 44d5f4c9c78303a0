// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "crowdface/cast/face_samples.h"
#include "crowdface/config/config.h"
#include "crowdface/core/file.h"
#include "crowdface/core/hash.h"
#include "crowdface/heads/cache_entry.h"
#include "crowdface/heads/cache_folder.h"
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
  Trajectory trajectory;
  StoredLevels levels;
};

/// What an entry must hold to be of use.
struct HeadCacheShape {
  Index vertices = 0;
  Index samples = 0;
  Index trajectory_levels = 0;  ///< rows of the trajectory
  Index nodes = 0;              ///< of `levels: basis`
  std::uint64_t max_level = 0;
  Levels levels = Levels::kBasis;
};

/// A prepared head from the cache, whose fields stay in the file, mapped; nothing if it is not there, or of another shape.
std::optional<PreparedHead> find_prepared(const CacheFolder& cache, const Digest& key,
                                          const HeadCacheShape& shape);

/// For `write_entry` or `store`.
CacheKey prepared_key(const Digest& digest);
std::vector<EntryArray> arrays_of(const PreparedHead& head);

}  // namespace crowdface
