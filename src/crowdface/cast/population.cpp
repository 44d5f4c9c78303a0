// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/population.h"

#include <algorithm>

namespace crowdface {

PopulationBalance::PopulationBalance(std::vector<TraitTarget> targets) {
  for (const TraitTarget& target : targets) {
    Trait& trait = traits_.emplace_back(Trait{target, {}, {}});
    trait.excess.assign(kBins, 0);
    trait.change.assign(kBins, 0);
    find_changes(trait);
  }
}

std::size_t PopulationBalance::bin_of(const TraitTarget& target, const Positions& landmarks) {
  const double share = normal_share(target, measure(measurements()[target.trait], landmarks));
  return std::min(static_cast<std::size_t>(share * static_cast<double>(kBins)), kBins - 1);
}

/// With one face more, every bin asks for one part of a face more, and all bins from that of the
/// face on have one face more.
void PopulationBalance::find_changes(Trait& trait) {
  double sum = 0;
  for (std::size_t b = kBins; b-- > 0;) {
    const double asked = static_cast<double>(b + 1) / static_cast<double>(kBins);
    sum += 2 * (trait.excess[b] - asked) + 1;
    trait.change[b] = sum;
  }
}

double PopulationBalance::cost(const Positions& landmarks) const {
  double sum = 0;
  for (const Trait& trait : traits_) sum += trait.change[bin_of(trait.target, landmarks)];
  return sum;
}

void PopulationBalance::add(const Positions& landmarks) {
  for (Trait& trait : traits_) {
    const std::size_t own = bin_of(trait.target, landmarks);
    for (std::size_t b = 0; b < kBins; ++b) {
      const double asked = static_cast<double>(b + 1) / static_cast<double>(kBins);
      trait.excess[b] += (b >= own ? 1 : 0) - asked;
    }
    find_changes(trait);
  }
}

}  // namespace crowdface
