// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/population.h"

#include <algorithm>
#include <cmath>

namespace crowdface {

PopulationBalance::PopulationBalance(const std::vector<TraitTarget>& targets) {
  for (const TraitTarget& target : targets) {
    Trait& trait = traits_.emplace_back(Trait{target, {}, {}});
    trait.cumulative_excess.assign(kBins, 0);
    trait.squared_excess_after_adding.assign(kBins, 0);
    update_squared_excess(trait);
  }
}

std::size_t PopulationBalance::bin_of(const TraitTarget& target, const Positions& landmarks) {
  const double share = normal_cdf(target, measure(measurements()[target.trait], landmarks));
  return std::min(static_cast<std::size_t>(share * static_cast<double>(kBins)), kBins - 1);
}

/// Updates Trait::squared_excess_after_adding. If a face joins the crowd, the requested number of
/// faces in bins 0 to b increases by (b + 1)/kBins, so `cumulative_excess` of bin b decreases by
/// this amount. If the face lies in one of these bins, `cumulative_excess` also increases by 1.
void PopulationBalance::update_squared_excess(Trait& trait) {
  const auto lacks = [&](std::size_t b) {
    return trait.cumulative_excess[b] - static_cast<double>(b + 1) / static_cast<double>(kBins);
  };
  double sum = 0;
  for (std::size_t b = 0; b < kBins; ++b) sum += lacks(b) * lacks(b);
  for (std::size_t b = kBins; b-- > 0;) {
    sum += 2 * lacks(b) + 1;
    trait.squared_excess_after_adding[b] = sum;
  }
}

double PopulationBalance::cost(const Positions& landmarks) const {
  double sum = 0;
  for (const Trait& trait : traits_) {
    const std::size_t bin = bin_of(trait.target, landmarks);
    sum += std::sqrt(std::max(trait.squared_excess_after_adding[bin], 0.0));
  }
  return sum;
}

void PopulationBalance::add(const Positions& landmarks) {
  for (Trait& trait : traits_) {
    const std::size_t own = bin_of(trait.target, landmarks);
    for (std::size_t b = 0; b < kBins; ++b) {
      const double asked = static_cast<double>(b + 1) / static_cast<double>(kBins);
      trait.cumulative_excess[b] += (b >= own ? 1 : 0) - asked;
    }
    update_squared_excess(trait);
  }
}

}  // namespace crowdface
