// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/training_recipe.h"

#include <algorithm>
#include <string>

#include "crowdface/core/random.h"
#include "crowdface/core/text.h"

namespace crowdface {

Recipe random_training_recipe(const HeadsAtSamples& heads, std::size_t bands, std::uint64_t index) {
  const auto head_count = static_cast<Index>(heads.heads.size());
  const auto draw = [&](const std::string& purpose, std::uint32_t lane) {
    return random_pair({0, index, purpose, 0}, lane);
  };
  const auto head_at = [&](double unit) {
    return std::min(static_cast<Index>(unit * static_cast<double>(head_count)), head_count - 1);
  };
  Recipe recipe;
  recipe.target = head_at(draw("training/target", 0)[0]);
  for (Index k = 0; k < heads.region_weights.cols(); ++k) {
    RegionRecipe region;
    region.finer_bands.resize(bands - 1);
    auto most = static_cast<double>(heads.levels.back());
    for (std::size_t b = 0; b < bands; ++b) {
      const std::string purpose = b == 0 ? concat("training/", k) : concat("training/", k, "/", b);
      BandRecipe& band = band_of(region, b);
      std::vector<SourceWeight> weights;
      for (std::uint32_t i = 0; i < 3; ++i) {
        const auto [which, weight] = draw(purpose, i);
        weights.push_back({head_at(which), weight * weight + 1e-3});
      }
      band.weights = normalized_weights(std::move(weights));
      const auto [level, factor] = draw(purpose, 3);
      // A band begins at a number of iterations L; the largest size of the band's detail is
      // proportional to √L. For the first band, L is uniformly random between 0 and the largest
      // level. For each finer band, √L (the size) is uniformly random between 0 and the √L of the
      // next coarser band.
      band.iterations = static_cast<std::uint64_t>(b == 0 ? level * most : level * level * most);
      band.extrapolation = 0.6 + 0.8 * factor;
      most = static_cast<double>(band.iterations);
    }
    recipe.regions.push_back(std::move(region));
  }
  if (heads.mirror_images != nullptr) {
    const auto [side, factor] = draw("training/mirror", 0);
    recipe.mirrored = side < 0.5;
    recipe.asymmetry = 0.5 + factor;
  }
  return recipe;
}

}  // namespace crowdface
