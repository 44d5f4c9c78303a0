// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/kept_face_space.h"

#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "crowdface/core/result_versions.h"
#include "crowdface/heads/kept_lists.h"

namespace crowdface {
namespace {

/// Rows and columns of levels, functions and directions, how many metrics; levels, functions, directions, metrics row by row.
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
  for (const FloatRows* rows : {&tables.levels, &tables.functions, &tables.directions}) {
    sizes.push_back(static_cast<std::uint64_t>(rows->rows()));
    sizes.push_back(static_cast<std::uint64_t>(rows->cols()));
  }
  sizes.push_back(tables.metrics.size());
  levels = row_by_row(tables.levels);
  functions = row_by_row(tables.functions);
  directions = row_by_row(tables.directions);
  for (const FloatRows& metric : tables.metrics) {
    metrics.insert(metrics.end(), metric.data(), metric.data() + metric.size());
  }
  return lists;
}

/// Finite numbers, row by row; in a forged entry sizes may be anything.
bool are_matrix(std::span<const float> numbers, std::uint64_t rows, std::uint64_t columns) {
  constexpr std::uint64_t kMost = 1U << 31U;
  return rows < kMost && columns < kMost && rows * columns == numbers.size() && all_finite(numbers);
}

/// \return nothing if the lists are none of tables
std::optional<FaceSpaceTables> tables_of(std::span<const std::uint64_t> sizes,
                                         std::span<const float> levels,
                                         std::span<const float> functions,
                                         std::span<const float> directions,
                                         std::span<const float> metrics) {
  if (sizes.size() != 7) return std::nullopt;
  if (!are_matrix(levels, sizes[0], sizes[1]) || !are_matrix(functions, sizes[2], sizes[3]) ||
      !are_matrix(directions, sizes[4], sizes[5])) {
    return std::nullopt;
  }
  const std::uint64_t rank = sizes[4];  // rows and columns of a metric
  if (!are_matrix(metrics, sizes[6], rank * rank)) return std::nullopt;
  const auto matrix = [](const float* numbers, std::uint64_t rows, std::uint64_t columns) {
    return Eigen::Map<const FloatRows>(numbers, static_cast<Index>(rows),
                                       static_cast<Index>(columns));
  };
  FaceSpaceTables tables{matrix(levels.data(), sizes[0], sizes[1]),
                         matrix(functions.data(), sizes[2], sizes[3]),
                         matrix(directions.data(), sizes[4], sizes[5]),
                         {}};
  for (std::uint64_t k = 0; k < sizes[6]; ++k) {
    tables.metrics.emplace_back(matrix(metrics.data() + k * rank * rank, rank, rank));
  }
  return tables;
}

}  // namespace

FaceSpace kept_face_space(const std::filesystem::path& cache, SampledHeads heads,
                          const std::vector<double>& weights, std::size_t bands) {
  if (cache.empty()) return FaceSpace(std::move(heads), weights, bands);
  std::optional<FaceSpace> made;
  std::optional<FaceSpaceTables> found;
  const Digest key = key_of(heads, weights, bands);
  kept_lists<std::uint64_t, float, float, float, float>(
      cache, key,
      [&] {
        made.emplace(std::move(heads), weights, bands);
        return lists_of(made->tables());
      },
      [&](const auto&... lists) {
        found = tables_of(lists...);
        return found && FaceSpace::fit(*found, heads);
      });
  return made ? *std::move(made) : FaceSpace(std::move(heads), weights, *std::move(found));
}

}  // namespace crowdface
