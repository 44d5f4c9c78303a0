// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/typical_head.h"

#include <algorithm>
#include <map>
#include <utility>

namespace crowdface {

Index typical_head(const Recipe& recipe, const HeadTags& tags) {
  if (recipe.mixture.empty() || tags.empty()) return recipe.target;
  std::map<std::string, double> shares;
  for (const SourceWeight& part : recipe.mixture) {
    for (const std::string& tag : tags[static_cast<std::size_t>(part.head)]) {
      shares[tag] += part.weight;
    }
  }
  // scores or weights of two heads that differ by at most this value count as equal (rounding
  // errors)
  constexpr double kTolerance = 1e-9;
  std::pair<double, double> best;
  Index typical = -1;
  // The score of a head is a sum over its tags: the total weight of the mixture's heads that have
  // the tag, minus the total weight of the heads that lack the tag.
  for (const SourceWeight& part : recipe.mixture) {
    double agrees = 0;
    for (const std::string& tag : tags[static_cast<std::size_t>(part.head)]) {
      agrees += 2 * shares[tag] - 1;
    }
    const bool better =
        agrees > best.first + kTolerance ||
        (agrees > best.first - kTolerance && part.weight > best.second + kTolerance);
    if (typical >= 0 && !better) continue;
    best = {agrees, part.weight};
    typical = part.head;
  }
  return typical;
}

}  // namespace crowdface
