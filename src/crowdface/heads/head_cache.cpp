// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/head_cache.h"

#include <algorithm>
#include <cmath>

#include "crowdface/heads/cached.h"
#include "crowdface/smooth/cubic_fit.h"

namespace crowdface {
namespace {

/// Whether the data of vector fields are consistent. Each tile stores a number of leading fields,
/// at most `rank`. There is one quantization step for each stored field of each tile. Each step is
/// zero or a power of two.
bool are_fields(const LevelFields& fields) {
  const auto& first = fields.first_field_of_tile;
  for (std::size_t t = 0; t + 1 < first.size(); ++t) {
    if (first[t + 1] < first[t] ||
        first[t + 1] - first[t] > static_cast<std::uint32_t>(fields.rank))
      return false;
  }
  const auto is_step = [](float step) {
    int exponent = 0;
    return step == 0 || std::frexp(step, &exponent) == 0.5F;
  };
  return first.empty() ? fields.quantization_steps.empty()
                       : first.front() == 0 && first.back() == fields.quantization_steps.size() &&
                             std::ranges::all_of(fields.quantization_steps, is_step);
}

constexpr auto kPreparedArrays = [](auto& arrays, auto& head) {
  auto& [fields, mapped, coefficients, error] = head.levels;
  arrays("mixing", coefficients);
  arrays("error max", error.max);
  arrays("error rms", error.rms);
  arrays("error level", error.level);
  arrays("trajectory", head.smoothing_trajectory);
  arrays("first fields", fields.first_field_of_tile);
  arrays("steps", fields.quantization_steps);
  arrays("numbers", fields.quantized_values);
};

/// Whether a prepared head that was read from the cache has these sizes and consistent vector
/// fields (LevelFields). Before the check, sets the vertex count and the rank of the vector fields,
/// which the cache does not store.
bool is_head(PreparedHead& head, const HeadCacheSizes& sizes) {
  const Eigen::MatrixXd& coefficients = head.levels.function_coefficients;
  LevelFields& fields = head.levels.fields;
  std::size_t firsts = 0;
  if (sizes.levels != LevelRepresentation::kExact) {
    fields.vertex_count = sizes.vertex_count;
    fields.rank =
        sizes.levels == LevelRepresentation::kCubic ? CubicFit::kRank : coefficients.cols();
    firsts = LevelFields::tile_count(static_cast<std::size_t>(sizes.vertex_count)) + 1;
  }
  const Index nodes = sizes.levels == LevelRepresentation::kBasis ? sizes.level_node_count : 0;
  return head.smoothing_trajectory.rows() == sizes.levels_per_smoothing_trajectory &&
         head.smoothing_trajectory.cols() == 3 * sizes.sample_count &&
         coefficients.rows() == nodes && coefficients.cols() <= nodes &&
         fields.first_field_of_tile.size() == firsts && are_fields(fields) &&
         fields.quantized_values.size() == fields.quantization_steps.size() * kTileValues;
}

}  // namespace

std::optional<PreparedHead> find_prepared(const CacheFolder& cache, const Digest& key,
                                          const HeadCacheSizes& sizes) {
  return find_cached<PreparedHead>(
      cache, prepared_key(key), kPreparedArrays, [&](PreparedHead& head, const CacheEntry& entry) {
        head.levels.fields.memory_owner = head.levels.mapped_file = entry.file();
        return is_head(head, sizes);
      });
}

CacheKey prepared_key(const Digest& digest) {
  return {kPreparedKind, digest};
}

std::vector<EntryArray> arrays_of(const PreparedHead& head) {
  return arrays_of(head, kPreparedArrays);
}

}  // namespace crowdface
