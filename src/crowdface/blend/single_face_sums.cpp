// SPDX-License-Identifier: Apache-2.0
#include "crowdface/blend/single_face_sums.h"

#include <algorithm>

#include "crowdface/blend/crowd_product_kernels.h"

namespace crowdface {
namespace {

/// How many tiles before its turn a tile's fields are fetched: memory takes longer than adding up one.
constexpr std::size_t kTilesAhead = 2;
/// Tiles whose places are in one line of the cache.
constexpr std::size_t kLineTiles = 64 / sizeof(std::uint32_t);

}  // namespace

void SingleFaceSums::start(std::span<const std::uint32_t> regions) {
  if (std::ranges::equal(regions, regions_)) return;
  regions_ = regions;
  next_of_ = kNoIndex;
  lenders_.clear();
  for (std::uint32_t h = 0; h < fields_.heads.size(); ++h) {
    const auto lends = [&](std::uint32_t k) {
      const auto coefficients = fields_.coefficients[k].begin();
      const auto first = static_cast<std::ptrdiff_t>(fields_.first_field[h]);
      const auto end = static_cast<std::ptrdiff_t>(fields_.first_field[h + 1]);
      return std::any_of(coefficients + first, coefficients + end, [](float c) { return c != 0; });
    };
    if (std::any_of(regions.begin(), regions.end(), lends)) lenders_.push_back(h);
  }
}

void SingleFaceSums::find_tiles(std::uint32_t vertex, std::vector<TileFields>& tiles) const {
  tiles.clear();
  for (const std::uint32_t h : lenders_) {
    tiles.push_back(fields_.heads[h]->at(vertex));
    __builtin_prefetch(tiles.back().steps);
    __builtin_prefetch(tiles.back().steps + tiles.back().count);
    __builtin_prefetch(fields_.heads[h]->first.data() + vertex / kFieldTile + kLineTiles);
  }
}

void SingleFaceSums::add_up(const VertexRun& run, const VertexRun& next,
                            std::span<const float* const> alpha, float* result) {
  if (next_of_ == run.first) {
    tiles_.swap(next_tiles_);
  } else {
    find_tiles(run.first, tiles_);
  }
  find_tiles(next.first, next_tiles_);
  next_of_ = next.first;
  const std::size_t values = std::size_t{3} * run.count, begin = 3 * (run.first % kFieldTile);
  std::fill_n(result, values, 0.0F);
  for (std::size_t first = 0; first < regions_.size(); first += kRegionsAtOnce) {
    const std::size_t count = std::min(kRegionsAtOnce, regions_.size() - first);
    add_regions(regions_.subspan(first, count), begin, begin + values);
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t i = 0; i < values; ++i) {
        result[i] += alpha[first + k][i] * sums_[k].values[begin + i];
      }
    }
  }
}

void SingleFaceSums::add_regions(std::span<const std::uint32_t> regions, std::size_t begin,
                                 std::size_t end) {
  for (TileSums& sums : sums_) sums.values.fill(0);
  for (std::size_t i = 0; i < lenders_.size(); ++i) {
    const TileFields& tile = tiles_[i];
    std::array<RegionSums, kRegionsAtOnce> of_tile{};
    for (std::size_t k = 0; k < regions.size(); ++k) {
      const float* coefficients =
          fields_.coefficients[regions[k]].data() + fields_.first_field[lenders_[i]];
      in_steps_[k].resize(tile.count);
      for (std::size_t p = 0; p < tile.count; ++p) {
        in_steps_[k][p] = coefficients[p] * tile.steps[p];
      }
      of_tile[k] = {in_steps_[k].data(), sums_[k].values.data()};
    }
    const std::size_t soon = i + kTilesAhead;
    const TileFields& ahead =
        soon < tiles_.size() ? tiles_[soon] : next_tiles_[(soon - tiles_.size()) % tiles_.size()];
    add_fields(tile.numbers, tile.count, std::span(of_tile).first(regions.size()), begin, end,
               ahead.numbers);
  }
}

}  // namespace crowdface
