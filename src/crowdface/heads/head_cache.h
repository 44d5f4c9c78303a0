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

/// The smoothing levels of one head, approximated by fields. The fields may lie in a memory-mapped
/// cache file, so that they use no memory of the process.
struct StoredLevels {
  /// the fields that approximate the smoothing levels; empty with `levels: exact`
  LevelFields fields;
  /// the file that holds the fields; null if they lie in memory
  std::shared_ptr<const MappedFile> mapped_file;
  /// Only for `levels: basis`: LevelBasis::function_coefficients. One row for each node of
  /// LevelNodes, and one column for each of `fields`.
  Eigen::MatrixXd function_coefficients;
  /// distances between the fitted levels and the exact filter; only for `levels: basis`
  BasisError error;
};

/// The cached data of a head: the trajectories of the sample points during smoothing, and the
/// fitted levels. With `levels: exact`, there are no fitted levels.
struct PreparedHead {
  Trajectory smoothing_trajectory;  ///< trajectories of the sample points during smoothing
  StoredLevels levels;  ///< the fitted smoothing levels of the head; empty with `levels: exact`
};

/// The sizes that the cache entry of a prepared head must have to be usable.
struct HeadCacheSizes {
  Index vertex_count = 0;  ///< number of vertices of the head
  Index sample_count = 0;  ///< number of sample points whose trajectory is stored
  /// number of smoothing levels at which each trajectory is stored
  Index levels_per_smoothing_trajectory = 0;
  /// number of levels at which the level functions are interpolated (LevelNodes); unused unless
  /// `levels` is kBasis
  Index level_node_count = 0;
  std::uint64_t max_level = 0;                               ///< L_max, see Inputs::max_level
  LevelRepresentation levels = LevelRepresentation::kBasis;  ///< the config's `levels`
};

/// Finds a prepared head in the cache. Its fields stay in the memory-mapped file. \return nothing
/// if the entry does not exist or has other sizes.
std::optional<PreparedHead> find_prepared(const CacheFolder& cache, const Digest& key,
                                          const HeadCacheSizes& sizes);

/// The cache key of a prepared head.
CacheKey prepared_key(const Digest& digest);
/// The arrays of a prepared head, for `write_entry` or `store`.
std::vector<EntryArray> arrays_of(const PreparedHead& head);

}  // namespace crowdface
