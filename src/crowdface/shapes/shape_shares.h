// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace crowdface {

/// How much one of several sets of shapes counts.
struct SetShare {
  std::uint32_t set;
  double share;
};
using SetShares = std::vector<SetShare>;

/// The sets whose shape a face has, region by region; those of a region add up to one.
using RegionShares = std::vector<SetShares>;

/// At a place that belongs to several regions.
/// \param alpha  #regions, of sum one
inline SetShares shares_at(std::span<const double> alpha, const RegionShares& of_region) {
  SetShares shares;
  for (std::size_t k = 0; k < of_region.size(); ++k) {
    if (alpha[k] == 0) continue;
    for (const SetShare& of_set : of_region[k]) {
      shares.push_back({of_set.set, alpha[k] * of_set.share});
    }
  }
  return shares;
}

}  // namespace crowdface
