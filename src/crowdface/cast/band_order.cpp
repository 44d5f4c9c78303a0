// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/band_order.h"

#include <set>

namespace crowdface {
namespace {

void begin_like(const BandRecipe& other, BandRecipe& band) {
  band.iterations = other.iterations;
  band.smoothness = other.smoothness;
}

}  // namespace

void restore_level_order(RegionRecipe& region) {
  for (std::size_t b = 1; b < band_count(region); ++b) {
    const BandRecipe& coarser = band_of(region, b - 1);
    BandRecipe& band = band_of(region, b);
    if (band.iterations > coarser.iterations) begin_like(coarser, band);
  }
}

void copy_bands(std::span<const std::size_t> band_indices, const Recipe& from, Recipe& recipe) {
  const std::set<std::size_t> taken(band_indices.begin(), band_indices.end());
  for (std::size_t k = 0; k < recipe.regions.size(); ++k) {
    RegionRecipe& region = recipe.regions[k];
    const std::size_t bands = band_count(region);
    const BandRecipe* finer = nullptr;  // the nearest finer band that was copied
    for (std::size_t b = bands; b-- > 0;) {
      BandRecipe& band = band_of(region, b);
      if (taken.contains(k * bands + b)) {
        band = band_of(from.regions[k], b);
        finer = &band;
      } else if (finer != nullptr && band.iterations < finer->iterations) {
        begin_like(*finer, band);
      }
    }
    restore_level_order(region);
  }
}

void copy_locked_bands(std::span<const std::size_t> band_indices, const Recipe& from,
                       Recipe& recipe) {
  recipe.target = from.target;
  recipe.mixture = from.mixture;
  recipe.asymmetry = from.asymmetry;
  recipe.mirrored = from.mirrored;
  copy_bands(band_indices, from, recipe);
}

}  // namespace crowdface
