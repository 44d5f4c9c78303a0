// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/prepare.h"

#include <algorithm>
#include <span>

#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/result_versions.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/heads/cached.h"
#include "crowdface/heads/shared_by_heads.h"
#include "crowdface/smooth/cubic_fit.h"
#include "crowdface/smooth/principal_directions.h"

namespace crowdface {
namespace {

constexpr Index kSampleCount = 2500;

Digest key_of(const Config& config, const Inputs& inputs, const FaceSamples& samples,
              std::size_t head) {
  const bool is_basis = config.smoothing.levels == LevelRepresentation::kBasis;
  return Hasher()
      .add(kPrepareVersion)
      .add(inputs.topology_digest)
      .add(inputs.head_digests[head])
      .add_array(std::span(samples))
      .add(inputs.max_level)
      .add(static_cast<int>(config.smoothing.boundary))
      .add(static_cast<int>(config.smoothing.operator_kind))
      .add(static_cast<int>(config.smoothing.levels))
      .add(is_basis ? config.smoothing.tolerance_mm / mm_per(config.faces.units) : 0.0)
      // The order of the filter's matrix rows depends on the first head. A basis is fitted to every
      // n-th row and so depends on this order.
      .add(is_basis ? inputs.head_digests.front() : Digest{})
      .digest();
}

/// Returns the largest allowed error of interpolating smoothed positions between the smoothing
/// levels that are nodes (see LevelNodes). The error is a fraction of the displacement that the
/// smoothing to the highest level causes. With this limit, the interpolation uses about a tenth of
/// the error tolerance (measured, docs/method.md). At the default tolerance of 0.05 mm, the limit
/// is 2·10⁻⁴.
double max_node_residual(const Config& config) {
  constexpr double kSharePerMm = 4e-3, kLargest = 1e-3;
  if (config.smoothing.levels != LevelRepresentation::kBasis) return 2e-4;
  return std::min(kSharePerMm * config.smoothing.tolerance_mm, kLargest);
}

/// Prepares heads that the cache lacks. Makes the smoothing filter when the first of these heads
/// needs it.
class HeadPreparation {
 public:
  HeadPreparation(const Config& config, const Inputs& inputs, const SmoothingOperator& smoothing,
                  PreparedHeads& prepared)
      : config_(config), inputs_(inputs), smoothing_(smoothing), prepared_(prepared) {}

  const ChebyshevFilter& filter() {
    if (!prepared_.filter) {
      prepared_.filter.emplace(smoothing_, inputs_.head_set.heads.front().positions);
    }
    return *prepared_.filter;
  }

  PreparedHead prepare(const Head& head) {
    const LevelNodes& nodes = *prepared_.nodes;
    PreparedHead result;
    const NodeFields fields = filter_nodes(filter(), nodes, head.positions);
    result.smoothing_trajectory =
        sample_smoothing_trajectory(filter(), nodes, fields, prepared_.trajectory_samples);
    if (config_.smoothing.levels == LevelRepresentation::kCubic) {
      result.levels.fields = fit_cubic(filter(), head.positions, inputs_.max_level).fields;
    }
    if (config_.smoothing.levels == LevelRepresentation::kBasis) {
      const double tolerance = config_.smoothing.tolerance_mm / mm_per(config_.faces.units);
      LevelBasis basis = fit_level_basis(filter(), nodes, fields, tolerance);
      result.levels.fields = std::move(basis.fields);
      result.levels.function_coefficients = std::move(basis.function_coefficients);
      result.levels.error = basis.error;
    }
    return result;
  }

 private:
  const Config& config_;
  const Inputs& inputs_;
  const SmoothingOperator& smoothing_;
  PreparedHeads& prepared_;
};

/// Removes temporary files of runs that were killed while writing to the cache. Errors only cause a
/// warning.
void clean_cache(const std::filesystem::path& cache) {
  try {
    remove_temporary_files(cache);
  } catch (const RecoverableError& error) {
    log_warning(error.what());
  }
}

PreparedHeads shared_by_heads(const Config& config, const Inputs& inputs) {
  PreparedHeads prepared;
  const auto chosen = [&](Index count) { return choose_samples(config, inputs, count); };
  if (inputs.mirror_map == nullptr) {
    prepared.trajectory_samples = prepared.samples = chosen(kSampleCount);
  } else {
    prepared.samples = samples_and_mirror_images(chosen(kSampleCount / 2), *inputs.mirror_map);
    prepared.trajectory_samples = samples_and_mirror_corners(prepared.samples, *inputs.mirror_map);
  }
  prepared.nodes = std::make_shared<const LevelNodes>(config.smoothing.operator_kind,
                                                      inputs.max_level, max_node_residual(config));
  return prepared;
}

/// The sizes that the cache entry of a prepared head must have.
HeadCacheSizes expected_sizes(const Config& config, const Inputs& inputs,
                              const PreparedHeads& prepared) {
  return {inputs.head_set.topology.vertex_count,
          static_cast<Index>(prepared.trajectory_samples.size()),
          static_cast<Index>(stored_smoothing_levels(inputs.max_level).size()),
          static_cast<Index>(prepared.nodes->levels().size()),
          inputs.max_level,
          config.smoothing.levels};
}

/// Loads the smoothing fields of all heads, grouped into patches of vertices, from the cache, or
/// else computes and caches them.
CachedPatches load_or_compute_patches(const Config& config, const Inputs& inputs,
                                      const PreparedHeads& prepared,
                                      const std::vector<Digest>& keys, const CacheFolder& cache) {
  const double tolerance = config.smoothing.tolerance_mm / mm_per(config.faces.units);
  double missed = 0;  // largest error of the heads' own fields
  std::vector<Index> ranks;
  Hasher hasher;
  hasher.add(kPatchVersion).add(tolerance);
  for (std::size_t h = 0; h < keys.size(); ++h) {
    hasher.add(keys[h]);
    ranks.push_back(prepared.levels[h].fields.rank);
    missed = std::max(missed, prepared.levels[h].error.max);
  }
  const double left = std::max(0.0, tolerance - missed);
  return cached_patches(cache, hasher.digest(), inputs.head_set.topology.vertex_count, ranks, [&] {
    const double two_edges = 2 * inputs.edge_length_mm / mm_per(config.faces.units);
    Progress progress("comparing heads patch by patch",
                      patch_count(static_cast<std::size_t>(inputs.head_set.topology.vertex_count)));
    return interpolate_fields(
        head_smoothings(config, prepared), make_tested_levels(*prepared.nodes).levels,
        vertex_order_for_patches(inputs.head_set.heads.front().positions, two_edges), left,
        [&](std::size_t patches) {
          throw_if_interrupted();
          progress.step(patches);
        });
  });
}

}  // namespace

void prepare_heads(const Config& config, const Inputs& inputs, const SmoothingOperator& smoothing,
                   const CacheFolder& cache, const std::function<bool(std::size_t)>& is_wanted) {
  PreparedHeads prepared = shared_by_heads(config, inputs);
  const HeadCacheSizes shape = expected_sizes(config, inputs, prepared);
  clean_cache(cache);
  HeadPreparation preparation(config, inputs, smoothing, prepared);
  for (std::size_t h = 0; h < inputs.head_set.heads.size(); ++h) {
    if (!is_wanted(h)) continue;
    throw_if_interrupted();
    const Digest key = key_of(config, inputs, prepared.trajectory_samples, h);
    if (find_prepared(cache, key, shape)) continue;
    write_entry(cache, prepared_key(key), arrays_of(preparation.prepare(inputs.head_set.heads[h])));
  }
}

PreparedHeads prepare(const Config& config, const Inputs& inputs,
                      const SmoothingOperator& smoothing, const CacheFolder& cache) {
  PreparedHeads prepared = shared_by_heads(config, inputs);
  const HeadCacheSizes shape = expected_sizes(config, inputs, prepared);
  clean_cache(cache);
  HeadPreparation preparation(config, inputs, smoothing, prepared);
  bool cache_works = true;
  std::optional<Progress> progress;
  progress.emplace("preparing heads", inputs.head_set.heads.size());
  std::vector<Digest> keys(inputs.head_set.heads.size());
  std::vector<std::optional<PreparedHead>> heads(keys.size());
  parallel_for_each(keys.size(), [&](std::size_t h) {
    throw_if_interrupted();
    keys[h] = key_of(config, inputs, prepared.trajectory_samples, h);
    heads[h] = find_prepared(cache, keys[h], shape);
  });
  for (std::size_t h = 0; h < heads.size(); ++h) {
    throw_if_interrupted();
    std::optional<PreparedHead>& head = heads[h];
    if (head) {
      ++prepared.cached_head_count;
    } else {
      head = preparation.prepare(inputs.head_set.heads[h]);
      // Stop writing after one failure: more warnings would not help the user.
      cache_works =
          cache_works && store(cache, prepared_key(keys[h]), arrays_of(*head), "prepared heads");
      // Use the mapped file from here on, so that only one head's fields are in memory at a time.
      if (cache_works) {
        if (auto written = find_prepared(cache, keys[h], shape)) head = std::move(written);
      }
    }
    prepared.trajectories.push_back(std::move(head->smoothing_trajectory));
    prepared.levels.push_back(std::move(head->levels));
    progress->step();
  }
  progress.reset();
  if (config.smoothing.levels == LevelRepresentation::kExact) {
    preparation.filter();
  } else {
    prepared.filter.reset();
    prepared.patches = load_or_compute_patches(config, inputs, prepared, keys, cache);
  }
  if (prepared.cached_head_count > 0) {
    log_info(concat(prepared.cached_head_count, " of ", inputs.head_set.heads.size(),
                    " prepared heads came from the cache"));
  }
  return prepared;
}

void throw_if_truncated(const PreparedHeads& prepared) {
  const auto was_truncated = [](const std::shared_ptr<const MappedFile>& mapped) {
    return mapped && mapped->was_truncated();
  };
  if (was_truncated(prepared.patches.mapped_file) ||
      std::ranges::any_of(prepared.levels,
                          [&](const auto& head) { return was_truncated(head.mapped_file); })) {
    throw TruncatedWhileInUse("a cache entry was truncated while it was in use");
  }
}

std::vector<HeadSmoothing> head_smoothings(const Config& config, const PreparedHeads& prepared) {
  std::vector<HeadSmoothing> result;
  for (const StoredLevels& stored : prepared.levels) {
    HeadSmoothing levels{stored.fields, {}};
    if (config.smoothing.levels == LevelRepresentation::kCubic) {
      levels.functions = [max_level = prepared.nodes->max_level()](std::uint64_t level) {
        const auto basis = cubic_basis(level, max_level);
        return std::vector<double>(basis.begin(), basis.end());
      };
    } else {
      levels.functions = [nodes = prepared.nodes,
                          coefficients = stored.function_coefficients](std::uint64_t level) {
        return level_function_values(*nodes, coefficients, level);
      };
    }
    result.push_back(std::move(levels));
  }
  return result;
}

}  // namespace crowdface
