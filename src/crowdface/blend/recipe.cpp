// SPDX-License-Identifier: Apache-2.0
#include "crowdface/blend/recipe.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/require.h"
#include "crowdface/mesh/mirror_map.h"

namespace crowdface {
namespace {

void divide_by_sum(std::vector<SourceWeight>& weights, double extra = 0) {
  double sum = extra;
  for (const SourceWeight& source : weights) sum += source.weight;
  if (sum == 0) return;
  for (SourceWeight& source : weights) source.weight /= sum;
}

/// Keeps the `count` largest weights, without changing their order. If weights are equal, keeps the
/// first.
void keep_largest(std::vector<SourceWeight>& weights, std::size_t count) {
  if (weights.size() <= count) return;
  std::stable_sort(weights.begin(), weights.end(),
                   [](const auto& a, const auto& b) { return a.weight > b.weight; });
  weights.resize(count);
  std::sort(weights.begin(), weights.end(),
            [](const auto& a, const auto& b) { return a.head < b.head; });
}

}  // namespace

std::size_t band_count(const RegionRecipe& region) {
  return 1 + region.finer_bands.size();
}

BandRecipe& band_of(RegionRecipe& region, std::size_t band) {
  if (band == 0) return region;
  return region.finer_bands[band - 1];
}

const BandRecipe& band_of(const RegionRecipe& region, std::size_t band) {
  if (band == 0) return region;
  return region.finer_bands[band - 1];
}

bool is_unmirrored(const Recipe& recipe) {
  return recipe.asymmetry == 1 && !recipe.mirrored;
}

double mirror_image_weight(const Recipe& recipe) {
  return mirror_image_weight(recipe.asymmetry, recipe.mirrored);
}

std::vector<LevelWeights> weights_by_level(const Recipe& recipe, std::size_t region,
                                           Extrapolation extrapolation) {
  const RegionRecipe& bands = recipe.regions[region];
  std::vector<LevelWeights> levels;
  // The weighted sum of each band is a difference of two terms (G_b in the comment of
  // weights_by_level, recipe.h). `coarser` has the weights of the heads in the first term. In the
  // first band, the first term is the target; in later bands, it is the mean of the heads that lend
  // the previous band, times the previous band's extrapolation factor.
  std::vector<SourceWeight> coarser = target_head_weights(recipe);
  for (std::size_t b = 0; b < band_count(bands); ++b) {
    const BandRecipe& band = band_of(bands, b);
    const double e = extrapolation == Extrapolation::kNone ? 1 : band.extrapolation;
    LevelWeights& level = levels.emplace_back(LevelWeights{band.iterations, std::move(coarser)});
    coarser.clear();
    for (const SourceWeight& source : band.weights) {
      level.weights.push_back({source.head, -e * source.weight});
      coarser.push_back({source.head, e * source.weight});
    }
  }
  return levels;
}

std::vector<SourceWeight> target_head_weights(const Recipe& recipe) {
  if (recipe.mixture.empty()) return {{recipe.target, 1}};
  return recipe.mixture;
}

void set_target_heads(Recipe& recipe, std::vector<SourceWeight> weights) {
  require(!weights.empty(), "a target of no head");
  const auto largest =
      std::max_element(weights.begin(), weights.end(),
                       [](const auto& a, const auto& b) { return a.weight < b.weight; });
  recipe.target = largest->head;
  if (weights.size() == 1) weights.clear();
  recipe.mixture = std::move(weights);
}

std::vector<SourceWeight> weights_at_position(const std::vector<PlanePoint>& anchors, Index target,
                                              const std::vector<Index>& sources,
                                              const PlanePoint& position,
                                              Normalization normalization,
                                              std::optional<int> max_sources) {
  std::vector<Index> heads = sources;
  if (std::find(heads.begin(), heads.end(), target) == heads.end()) {
    heads.insert(std::upper_bound(heads.begin(), heads.end(), target), target);
  }
  std::vector<PlanePoint> taking_part;
  for (const Index head : heads) taking_part.push_back(anchors[static_cast<std::size_t>(head)]);
  const std::vector<double> omega = inverse_square_weights(taking_part, position);  // Eq. 4

  std::vector<SourceWeight> weights;
  SourceWeight omega_0{target, 0};
  for (std::size_t i = 0; i < heads.size(); ++i) {
    if (heads[i] == target) {
      omega_0.weight = omega[i];
    } else {
      weights.push_back({heads[i], omega[i]});
    }
  }
  if (max_sources) keep_largest(weights, static_cast<std::size_t>(*max_sources));
  const bool takes_part = normalization == Normalization::kPartition;
  if (takes_part) {
    const auto after = std::find_if(weights.begin(), weights.end(),
                                    [&](const auto& source) { return source.head > target; });
    weights.insert(after, omega_0);
  }
  divide_by_sum(weights, takes_part ? 0 : omega_0.weight);  // ω̂_i, the quotient of Eq. 3
  std::erase_if(weights, [](const SourceWeight& source) { return source.weight == 0; });
  return weights;
}

std::vector<SourceWeight> normalized_weights(std::vector<SourceWeight> weights) {
  double sum = 0;
  for (const SourceWeight& source : weights) {
    require(source.weight >= 0 && std::isfinite(source.weight), "a weight of ", source.weight);
    sum += source.weight;
  }
  require(sum > 0 && std::isfinite(sum), "weights that sum to ", sum);
  std::erase_if(weights, [](const SourceWeight& source) { return source.weight == 0; });
  std::sort(weights.begin(), weights.end(),
            [](const auto& a, const auto& b) { return a.head < b.head; });
  divide_by_sum(weights);
  return weights;
}

}  // namespace crowdface
