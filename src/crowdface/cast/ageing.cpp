// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/ageing.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "crowdface/core/require.h"

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

void apply_age(CastFace& face, double age, const SamplingOptions& sampling) {
  if (age == 0) return;
  const std::vector<Index>& heads = age > 0 ? sampling.old_heads : sampling.young_heads;
  require(!heads.empty(), "an age of ", age, " without heads of that age");
  std::vector<SourceWeight> along;
  for (const Index head : heads) along.push_back({head, 1 / static_cast<double>(heads.size())});
  for (RegionRecipe& region : face.recipe.regions) {
    region.weights = mixed_weights(region.weights, along, age > 0 ? age : -age);
    region.position.reset();
  }
  face.age = age;
}

void take_back_age(CastFace& face, const SamplingOptions& sampling) {
  constexpr double kRounding = 1e-9;
  const double share = std::abs(face.age.value_or(0));
  if (share == 0 || share > 1 - kRounding) return;
  const std::vector<Index>& heads = *face.age > 0 ? sampling.old_heads : sampling.young_heads;
  const double each = share / static_cast<double>(heads.size());
  for (RegionRecipe& region : face.recipe.regions) {
    for (SourceWeight& source : region.weights) {
      const bool aged = std::binary_search(heads.begin(), heads.end(), source.head);
      source.weight = (source.weight - (aged ? each : 0)) / (1 - share);
    }
    std::erase_if(region.weights, [](const SourceWeight& s) { return s.weight < kRounding; });
  }
  face.age.reset();
}

}  // namespace crowdface
