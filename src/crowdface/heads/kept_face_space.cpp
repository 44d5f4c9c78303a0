// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/kept_face_space.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "crowdface/core/result_versions.h"
#include "crowdface/heads/cached.h"

namespace crowdface {
namespace {

template <class Matrix>
void add_matrix(Hasher& hasher, const Matrix& matrix) {
  hasher.add(matrix.cols())
      .add_array(std::span(matrix.data(), static_cast<std::size_t>(matrix.size())));
}

void add_heads(Hasher& hasher, const SampledHeads& heads) {
  hasher.add(heads.heads.size()).add(heads.mm_per_unit);
  for (const Positions& head : heads.heads) add_matrix(hasher, head);
  for (const Trajectory& trajectory : heads.trajectories) add_matrix(hasher, trajectory);
  add_matrix(hasher, heads.mean);
  add_matrix(hasher, heads.alpha);
  hasher.add_array(std::span(heads.levels)).add(heads.image != nullptr);
  if (heads.image != nullptr) add_heads(hasher, *heads.image);
}

Digest digest_of(const SampledHeads& heads, const std::vector<double>& weights, std::size_t bands) {
  Hasher hasher;
  hasher.add(kFaceSpaceVersion).add(bands).add_array(std::span(weights));
  add_heads(hasher, heads);
  return hasher.digest();
}

/// Each metric is a row.
FloatRows metric_rows(const FaceSpaceTables& tables) {
  const Index rank = tables.directions.rows();
  FloatRows rows(static_cast<Index>(tables.metrics.size()), rank * rank);
  for (Index k = 0; k < rows.rows(); ++k) {
    std::ranges::copy(tables.metrics[static_cast<std::size_t>(k)].reshaped<Eigen::RowMajor>(),
                      rows.row(k).begin());
  }
  return rows;
}

FaceSpaceTables tables_of(const CacheEntry& entry, const SampledHeads& heads) {
  constexpr double kAny = std::numeric_limits<float>::max();
  FaceSpaceTables tables{entry.matrix<FloatRows>("levels", kAny),
                         entry.matrix<FloatRows>("functions", kAny),
                         entry.matrix<FloatRows>("directions", kAny),
                         {}};
  const auto metrics = entry.matrix<FloatRows>("metrics", kAny);
  const Index rank = tables.directions.rows();
  entry.require(metrics.cols() == rank * rank);
  for (Index k = 0; k < metrics.rows(); ++k) {
    tables.metrics.emplace_back(Eigen::Map<const FloatRows>(metrics.row(k).data(), rank, rank));
  }
  entry.require(FaceSpace::fit(tables, heads));
  return tables;
}

}  // namespace

FaceSpace kept_face_space(const CacheFolder& cache, SampledHeads heads,
                          const std::vector<double>& weights, std::size_t bands) {
  if (cache.path.empty()) return FaceSpace(std::move(heads), weights, bands);
  const CacheKey key{"face-space", digest_of(heads, weights, bands)};
  auto tables =
      find_cached(cache, key, [&](const CacheEntry& entry) { return tables_of(entry, heads); });
  if (tables) return FaceSpace(std::move(heads), weights, *std::move(tables));
  FaceSpace made(std::move(heads), weights, bands);
  store(cache, key,
        {array_of("levels", made.tables().levels), array_of("functions", made.tables().functions),
         array_of("directions", made.tables().directions),
         owned_array("metrics", metric_rows(made.tables()))});
  return made;
}

}  // namespace crowdface
