// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/mixed_recipe.h"

#include <map>

namespace crowdface {

std::vector<SourceWeight> mixed_weights(const std::vector<SourceWeight>& a,
                                        const std::vector<SourceWeight>& b, double t) {
  std::map<Index, double> sum;
  for (const SourceWeight& source : a) sum[source.head] += (1 - t) * source.weight;
  for (const SourceWeight& source : b) sum[source.head] += t * source.weight;
  std::vector<SourceWeight> mixed;
  for (const auto& [head, weight] : sum) {
    if (weight > 0) mixed.push_back({head, weight});
  }
  return mixed;
}

double mixed(double a, double b, double t) {
  return a == b ? a : (1 - t) * a + t * b;
}

BandRecipe mixed(const BandRecipe& a, const BandRecipe& b, double t,
                 const SmoothingLevelScale& scale) {
  BandRecipe band;
  band.weights = mixed_weights(a.weights, b.weights, t);
  band.smoothness = (1 - t) * a.smoothness + t * b.smoothness;
  band.iterations = iterations_of(band.smoothness, scale);
  band.extrapolation = (1 - t) * a.extrapolation + t * b.extrapolation;
  return band;
}

Recipe mixed(const Recipe& from, const Recipe& to, double t, const SmoothingLevelScale& scale) {
  Recipe recipe = to;
  set_target_heads(recipe, mixed_weights(target_head_weights(from), target_head_weights(to), t));
  recipe.asymmetry = mixed(from.asymmetry, to.asymmetry, t);
  recipe.mirrored = from.mirrored;
  for (std::size_t k = 0; k < recipe.regions.size(); ++k) {
    RegionRecipe& region = recipe.regions[k];
    for (std::size_t b = 0; b < band_count(region); ++b) {
      BandRecipe& band = band_of(region, b);
      band = mixed(band_of(from.regions[k], b), band, t, scale);
    }
  }
  return recipe;
}

}  // namespace crowdface
