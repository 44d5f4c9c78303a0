// SPDX-License-Identifier: Apache-2.0
#include "crowdface/job/prepare.h"

#include <span>

#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/job/head_cache.h"

namespace crowdface {
namespace {

/// Raised whenever a change of the code alters what an entry holds.
constexpr int kPrepareVersion = 1;
constexpr Index kSamples = 1500;

Positions mean_head(const FaceSet& faces) {
  Positions mean = Positions::Zero(faces.topology.vertex_count, 3);
  for (const Head& head : faces.heads) mean += head.positions;
  return mean / static_cast<double>(faces.heads.size());
}

Digest key_of(const Config& config, const Inputs& inputs, const FaceSamples& samples,
              std::size_t head) {
  return Hasher()
      .add(kPrepareVersion)
      .add(inputs.topology_digest)
      .add(inputs.head_digests[head])
      .add_array(std::span(samples))
      .add(inputs.max_level)
      .add(static_cast<int>(config.smoothing.boundary))
      .add(static_cast<int>(config.smoothing.operator_kind))
      .add(static_cast<int>(config.smoothing.levels))
      .digest();
}

PreparedHead prepare_head(const Positions& positions, const SmoothingOperator& smoothing,
                          const FaceSamples& samples, std::uint64_t max_level, Levels levels) {
  PreparedHead head;
  head.max_level = max_level;
  head.trajectory = sample_trajectory(smoothing, positions, samples, max_level);
  if (levels == Levels::kCubic) head.fit = fit_cubic(smoothing, positions, max_level);
  return head;
}

std::optional<PreparedHead> from_cache(const std::filesystem::path& cache, const Digest& key,
                                       const HeadCacheShape& shape) {
  try {
    return read_cached_head(cache, key, shape);
  } catch (const Error& error) {
    log_warning(concat(error.what(), "; it is made anew"));
    return std::nullopt;
  }
}

/// \return whether writing works; after one failure there is no point in more warnings.
bool into_cache(const std::filesystem::path& cache, const Digest& key, const PreparedHead& head) {
  try {
    write_cached_head(cache, key, head);
    return true;
  } catch (const Error& error) {
    log_warning(concat("prepared heads cannot be kept: ", error.what()));
    return false;
  }
}

}  // namespace

Prepared prepare(const Config& config, const Inputs& inputs, const SmoothingOperator& smoothing,
                 const std::filesystem::path& cache) {
  Prepared prepared;
  prepared.samples = choose_face_samples(inputs.faces.topology, inputs.components,
                                         mean_head(inputs.faces), config.faces.front, kSamples);
  const bool fitted = config.smoothing.levels == Levels::kCubic;
  const HeadCacheShape shape = {
      inputs.faces.topology.vertex_count, static_cast<Index>(prepared.samples.size()),
      static_cast<Index>(trajectory_levels(inputs.max_level).size()), inputs.max_level, fitted};
  bool cache_works = true;
  Progress progress("preparing heads", inputs.faces.heads.size());
  for (std::size_t h = 0; h < inputs.faces.heads.size(); ++h) {
    throw_if_interrupted();
    const Digest key = key_of(config, inputs, prepared.samples, h);
    std::optional<PreparedHead> head = from_cache(cache, key, shape);
    if (head) {
      ++prepared.from_cache;
    } else {
      head = prepare_head(inputs.faces.heads[h].positions, smoothing, prepared.samples,
                          inputs.max_level, config.smoothing.levels);
      cache_works = cache_works && into_cache(cache, key, *head);
    }
    prepared.trajectories.push_back(std::move(head->trajectory));
    if (head->fit) prepared.fits.push_back(std::move(*head->fit));
    progress.step();
  }
  if (prepared.from_cache > 0) {
    log_info(concat(prepared.from_cache, " of ", inputs.faces.heads.size(),
                    " prepared heads came from the cache"));
  }
  return prepared;
}

}  // namespace crowdface
