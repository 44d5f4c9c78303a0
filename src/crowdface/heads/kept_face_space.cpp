// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/kept_face_space.h"

#include <cstdint>
#include <span>
#include <tuple>
#include <utility>

#include "crowdface/core/result_versions.h"
#include "crowdface/heads/kept_lists.h"

namespace crowdface {
namespace {

/// How many modes, functions, directions and metrics; levels, functions, directions, metrics row by row.
using Lists = std::tuple<std::vector<std::uint64_t>, std::vector<float>, std::vector<float>,
                         std::vector<float>, std::vector<float>>;

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

Digest key_of(const SampledHeads& heads, const std::vector<double>& weights, std::size_t bands) {
  Hasher hasher;
  hasher.add(kFaceSpaceVersion).add("face space").add(bands).add_array(std::span(weights));
  add_heads(hasher, heads);
  return hasher.digest();
}

std::vector<float> row_by_row(const FloatRows& rows) {
  return {rows.data(), rows.data() + rows.size()};
}

Lists lists_of(const FaceSpaceTables& tables) {
  Lists lists;
  auto& [sizes, levels, functions, directions, metrics] = lists;
  for (const Index size : {tables.levels.cols(), tables.functions.cols(), tables.directions.rows(),
                           static_cast<Index>(tables.metrics.size())}) {
    sizes.push_back(static_cast<std::uint64_t>(size));
  }
  levels = row_by_row(tables.levels);
  functions = row_by_row(tables.functions);
  directions = row_by_row(tables.directions);
  for (const FloatRows& metric : tables.metrics) {
    metrics.insert(metrics.end(), metric.data(), metric.data() + metric.size());
  }
  return lists;
}

/// \return none that fit any heads, if the lists are none of tables
FaceSpaceTables tables_of(const Lists& lists) {
  const auto& [sizes, levels, functions, directions, metrics] = lists;
  FaceSpaceTables tables;
  if (sizes.size() != 4) return tables;
  bool whole = true;
  const auto rows_of = [&](std::span<const float> numbers, std::uint64_t columns) -> FloatRows {
    if (columns == 0) return FloatRows(0, 0);
    whole = whole && numbers.size() % columns == 0;
    if (!whole) return FloatRows(0, 0);
    return Eigen::Map<const FloatRows>(numbers.data(), static_cast<Index>(numbers.size() / columns),
                                       static_cast<Index>(columns));
  };
  tables.levels = rows_of(levels, sizes[0]);
  tables.functions = rows_of(functions, sizes[1]);
  tables.directions = rows_of(directions, 3 * sizes[1]);
  if (sizes[3] > 0 && metrics.size() % sizes[3] == 0) {
    const std::size_t each = metrics.size() / sizes[3];
    for (std::uint64_t k = 0; k < sizes[3]; ++k) {
      tables.metrics.push_back(rows_of(std::span(metrics).subspan(k * each, each), sizes[2]));
    }
  }
  return whole ? tables : FaceSpaceTables();
}

}  // namespace

FaceSpace kept_face_space(const std::filesystem::path& cache, SampledHeads heads,
                          const std::vector<double>& weights, std::size_t bands) {
  if (cache.empty()) return FaceSpace(std::move(heads), weights, bands);
  const auto make = [&] { return lists_of(FaceSpace(heads, weights, bands).tables()); };
  const auto is_sound = [&](const auto&... lists) {
    return FaceSpace::fit(tables_of(Lists(lists...)), heads);
  };
  const Lists lists = kept_lists<std::uint64_t, float, float, float, float>(
      cache, key_of(heads, weights, bands), make, is_sound);
  return FaceSpace(std::move(heads), weights, tables_of(lists));
}

}  // namespace crowdface
