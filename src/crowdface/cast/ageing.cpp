// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/ageing.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "crowdface/core/require.h"

namespace crowdface {
namespace {

/// Returns the fraction of a band's weights that an age moves.
double share_of(double age, const SamplingOptions& sampling, std::size_t band) {
  return std::abs(age) * (sampling.bands.empty() ? 1 : sampling.bands[band].ageing);
}

}  // namespace

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

void apply_age(FacePlan& face, double age, const SamplingOptions& sampling) {
  if (age == 0) return;
  const std::vector<Index>& heads = age > 0 ? sampling.old_heads : sampling.young_heads;
  require(!heads.empty(), "an age of ", age, " without heads of that age");
  std::vector<SourceWeight> along;
  for (const Index head : heads) along.push_back({head, 1 / static_cast<double>(heads.size())});
  for (RegionRecipe& region : face.recipe.regions) {
    for (std::size_t b = 0; b < band_count(region); ++b) {
      const double share = share_of(age, sampling, b);
      if (share == 0) continue;
      BandRecipe& band = band_of(region, b);
      band.weights = mixed_weights(band.weights, along, share);
      band.position.reset();
    }
  }
  face.age = age;
}

void take_back_age(FacePlan& face, const SamplingOptions& sampling) {
  constexpr double kRounding = 1e-9;
  if (face.age.value_or(0) == 0) return;
  const std::vector<Index>& heads = *face.age > 0 ? sampling.old_heads : sampling.young_heads;
  bool known = true;
  for (RegionRecipe& region : face.recipe.regions) {
    for (std::size_t b = 0; b < band_count(region); ++b) {
      const double share = share_of(*face.age, sampling, b);
      known = known && share <= 1 - kRounding;
      if (share == 0 || share > 1 - kRounding) continue;
      const double each = share / static_cast<double>(heads.size());
      std::vector<SourceWeight>& weights = band_of(region, b).weights;
      for (SourceWeight& source : weights) {
        const bool aged = std::binary_search(heads.begin(), heads.end(), source.head);
        source.weight = (source.weight - (aged ? each : 0)) / (1 - share);
      }
      std::erase_if(weights, [](const SourceWeight& s) { return s.weight < kRounding; });
    }
  }
  if (known) face.age.reset();
}

}  // namespace crowdface
