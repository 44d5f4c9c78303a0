// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/cached_face_space.h"

#include <span>
#include <utility>

#include "crowdface/core/result_versions.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/cached.h"

namespace crowdface {
namespace {

template <class Matrix>
void add_matrix(Hasher& hasher, const Matrix& matrix) {
  hasher.add(matrix.cols())
      .add_array(std::span(matrix.data(), static_cast<std::size_t>(matrix.size())));
}

void add_heads(Hasher& hasher, const HeadsAtSamples& heads) {
  hasher.add(heads.heads.size()).add(heads.mm_per_unit);
  for (const Positions& head : heads.heads) add_matrix(hasher, head);
  for (const Trajectory& trajectory : heads.trajectories) add_matrix(hasher, trajectory);
  add_matrix(hasher, heads.mean);
  add_matrix(hasher, heads.region_weights);
  hasher.add_array(std::span(heads.levels)).add(heads.mirror_images != nullptr);
  if (heads.mirror_images != nullptr) add_heads(hasher, *heads.mirror_images);
}

Digest face_space_digest(const HeadsAtSamples& heads, const std::vector<double>& weights,
                         std::size_t bands) {
  Hasher hasher;
  hasher.add(kFaceSpaceVersion).add(bands).add_array(std::span(weights));
  add_heads(hasher, heads);
  return hasher.digest();
}

constexpr auto kFaceSpaceArrays = [](auto& arrays, auto& tables) {
  arrays("levels", tables.level_coefficients);
  arrays("functions", tables.basis_coefficients);
  arrays("directions", tables.principal_directions);
  for (std::size_t k = 0; k < tables.region_metrics.size(); ++k) {
    arrays(concat("metric ", k), tables.region_metrics[k]);
  }
};

}  // namespace

FaceSpace cached_face_space(const CacheFolder& cache, HeadsAtSamples heads,
                            const std::vector<double>& weights, std::size_t bands) {
  if (cache.path.empty()) return FaceSpace(std::move(heads), weights, bands);
  const CacheKey key{"face-space", face_space_digest(heads, weights, bands)};
  FaceSpaceTables room;
  if (heads.region_weights.cols() > 1)
    room.region_metrics.resize(static_cast<std::size_t>(heads.region_weights.cols()));
  auto tables = find_cached(
      cache, key, kFaceSpaceArrays,
      [&](const FaceSpaceTables& found, const CacheEntry&) {
        return FaceSpace::have_matching_sizes(found, heads);
      },
      std::move(room));
  if (tables) return FaceSpace(std::move(heads), weights, *std::move(tables));
  FaceSpace made(std::move(heads), weights, bands);
  store(cache, key, arrays_of(made.tables(), kFaceSpaceArrays));
  return made;
}

}  // namespace crowdface
