// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/head_cache.h"

#include <algorithm>
#include <cmath>

#include "crowdface/heads/cache_folder.h"
#include "crowdface/smooth/cubic_fit.h"

namespace crowdface {
namespace {

/// Whether each tile has some of the first fields, all of them together what there is, with steps that a value can have.
bool are_fields(const LevelFields& fields) {
  const auto& first = fields.first;
  for (std::size_t t = 0; t + 1 < first.size(); ++t) {
    if (first[t + 1] < first[t] ||
        first[t + 1] - first[t] > static_cast<std::uint32_t>(fields.rank))
      return false;
  }
  const auto is_step = [](float step) {
    int exponent = 0;
    return step == 0 || std::frexp(step, &exponent) == 0.5F;
  };
  return first.empty() ? fields.steps.empty()
                       : first.front() == 0 && first.back() == fields.steps.size() &&
                             std::ranges::all_of(fields.steps, is_step);
}

}  // namespace

CacheKey prepared_key(const Digest& digest) {
  return {kPreparedKind, digest};
}

PreparedHead prepared_head(const CacheEntry& entry, const HeadCacheShape& shape) {
  PreparedHead head;
  head.trajectory = entry.matrix<Trajectory>("trajectory");
  entry.require(head.trajectory.rows() == shape.trajectory_levels &&
                head.trajectory.cols() == 3 * shape.samples);
  StoredLevels& levels = head.levels;
  levels.mixing = entry.matrix<Eigen::MatrixXd>("mixing");
  levels.error = {entry.value<double>("error max"), entry.value<double>("error rms"),
                  entry.value<std::uint64_t>("error level")};
  LevelFields& fields = levels.fields;
  fields.first = entry.get<std::uint32_t>("first fields");
  fields.steps = entry.get<float>("steps");
  fields.numbers = entry.get<std::int16_t>("numbers");
  fields.owner = levels.mapped = entry.file();
  std::size_t firsts = 0;
  if (shape.levels != Levels::kExact) {
    fields.vertex_count = shape.vertices;
    fields.rank = shape.levels == Levels::kCubic ? CubicFit::kRank : levels.mixing.cols();
    firsts = LevelFields::tile_count(static_cast<std::size_t>(shape.vertices)) + 1;
  }
  const Index nodes = shape.levels == Levels::kBasis ? shape.nodes : 0;
  entry.require(levels.mixing.rows() == nodes && levels.mixing.cols() <= nodes &&
                fields.first.size() == firsts && are_fields(fields) &&
                fields.numbers.size() == fields.steps.size() * kTileValues);
  return head;
}

std::vector<EntryArray> arrays_of(const PreparedHead& head) {
  const StoredLevels& levels = head.levels;
  return {
      array_of("mixing", levels.mixing),          value_array("error max", levels.error.max),
      value_array("error rms", levels.error.rms), value_array("error level", levels.error.level),
      array_of("trajectory", head.trajectory),    array_of("first fields", levels.fields.first),
      array_of("steps", levels.fields.steps),     array_of("numbers", levels.fields.numbers)};
}

}  // namespace crowdface
