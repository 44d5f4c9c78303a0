// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/level_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "crowdface/core/parallel.h"
#include "crowdface/smooth/field_kernels.h"

namespace crowdface {
namespace {

struct OwnedFields {
  std::vector<std::uint32_t> first_field_of_tile;
  std::vector<float> quantization_steps;
  std::vector<std::int16_t> quantized_values;
};

}  // namespace

double LevelFields::value(Index field, Index vertex, Index coordinate) const {
  const auto v = static_cast<std::size_t>(vertex), f = static_cast<std::size_t>(field);
  const TileFields tile = tile_fields(v);
  if (f >= tile.count) return 0;
  const std::size_t place =
      f * kTileValues + 3 * (v % kTileVertices) + static_cast<std::size_t>(coordinate);
  return static_cast<double>(tile.quantization_steps[f]) *
         static_cast<double>(tile.quantized_values[place]);
}

float quantization_step(std::span<const float> values) {
  constexpr float kMax = std::numeric_limits<std::int16_t>::max();
  float largest = 0;
  for (const float value : values) largest = std::max(largest, std::abs(value));
  if (largest < 1e-30F) return 0;  // the inverse of the step would overflow
  int exponent = 0;                // largest/kMax = m·2^exponent, ½ ≤ m < 1
  const float m = std::frexp(largest / kMax, &exponent);
  return std::ldexp(1.0F, m == 0.5F ? exponent - 1 : exponent);
}

float quantize(std::span<const float> values, std::int16_t* quantized) {
  const float step = quantization_step(values);
  round_to_int16(values.data(), values.size(), step > 0 ? 1 / step : 0, quantized);
  return step;
}

void QuantizedTiles::add(std::span<const float> values, std::size_t count) {
  field_counts.push_back(static_cast<std::uint32_t>(count));
  quantized_values.resize(quantized_values.size() + count * kTileValues);
  std::int16_t* to = quantized_values.data() + quantized_values.size() - count * kTileValues;
  for (std::size_t p = 0; p < count; ++p) {
    const std::size_t at = p * kTileValues;
    quantization_steps.push_back(quantize(values.subspan(at, kTileValues), to + at));
  }
}

LevelFields concatenate(Index vertex_count, Index rank, std::vector<QuantizedTiles> tiles) {
  auto all = std::make_shared<OwnedFields>();
  all->first_field_of_tile.push_back(0);
  for (QuantizedTiles& part : tiles) {
    for (const std::uint32_t count : part.field_counts)
      all->first_field_of_tile.push_back(all->first_field_of_tile.back() + count);
    all->quantization_steps.insert(all->quantization_steps.end(), part.quantization_steps.begin(),
                                   part.quantization_steps.end());
  }
  all->quantized_values.reserve(all->quantization_steps.size() * kTileValues);
  for (QuantizedTiles& part : tiles) {
    all->quantized_values.insert(all->quantized_values.end(), part.quantized_values.begin(),
                                 part.quantized_values.end());
    part = QuantizedTiles();
  }
  return {vertex_count,          rank, all->first_field_of_tile, all->quantization_steps,
          all->quantized_values, all};
}

LevelFields quantize(std::span<const float> fields, Index vertex_count) {
  const std::size_t values = 3 * static_cast<std::size_t>(vertex_count);
  const std::size_t rank = values == 0 ? 0 : fields.size() / values;
  std::vector<QuantizedTiles> tiles(
      LevelFields::tile_count(static_cast<std::size_t>(vertex_count)));
  parallel_for_each(tiles.size(), [&](std::size_t tile) {
    const std::size_t first = tile * kTileValues;
    std::vector<float> of_tile(rank * kTileValues, 0.0F);
    for (std::size_t p = 0; p < rank; ++p) {
      std::copy_n(fields.data() + p * values + first, std::min(kTileValues, values - first),
                  of_tile.data() + p * kTileValues);
    }
    tiles[tile].add(of_tile, rank);
  });
  return concatenate(vertex_count, static_cast<Index>(rank), std::move(tiles));
}

}  // namespace crowdface
