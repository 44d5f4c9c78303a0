// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/level_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "crowdface/core/parallel.h"
#include "crowdface/smooth/field_kernels.h"

namespace crowdface {
namespace {

/// The largest number's step: 0 if all are zero.
double step_of(std::span<const float> field) {
  float largest = 0;
  for (const float value : field) largest = std::max(largest, std::abs(value));
  return static_cast<double>(largest) / std::numeric_limits<std::int16_t>::max();
}

}  // namespace

LevelFields in_16_bits(std::span<const float> fields, Index vertex_count) {
  const std::size_t values = 3 * static_cast<std::size_t>(vertex_count);
  const std::size_t rank = values == 0 ? 0 : fields.size() / values;
  LevelFields result{vertex_count, std::vector<double>(rank), {}, {}};
  const auto field = [&](std::size_t p) { return fields.subspan(p * values, values); };
  parallel_for_each(rank, [&](std::size_t p) { result.steps[p] = step_of(field(p)); });

  constexpr std::size_t kTileValues = 3 * kFieldTile;
  auto numbers = std::make_shared<std::vector<std::int16_t>>(
      LevelFields::size(static_cast<std::size_t>(vertex_count), rank));
  parallel_for_each((values + kTileValues - 1) / kTileValues, [&](std::size_t tile) {
    const std::size_t first = tile * kTileValues;
    for (std::size_t p = 0; p < rank; ++p) {
      const double step = result.steps[p];
      narrow(fields.data() + p * values + first, std::min(kTileValues, values - first),
             step > 0 ? static_cast<float>(1 / step) : 0,
             numbers->data() + (tile * rank + p) * kTileValues);
    }
  });
  result.numbers = *numbers;
  result.owner = std::move(numbers);
  return result;
}

}  // namespace crowdface
