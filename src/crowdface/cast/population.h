// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/traits/trait_limits.h"

namespace crowdface {

/// Steers casting so that measurements of a crowd have requested distributions. Chooses the
/// candidate that brings the crowd so far nearest to these distributions: the sum over the traits
/// of the root mean square differences between both cumulative distributions (after Cramér and von
/// Mises, on a grid) is smallest. Because of the roots, a distribution that the heads cannot reach
/// does not outweigh the others. A choice depends on earlier faces only, so a larger crowd changes
/// no choice.
class PopulationBalance {
 public:
  explicit PopulationBalance(const std::vector<TraitTarget>& targets);

  /// Returns how far the crowd with this face would be from the requested distributions; only for
  /// comparing candidates. \param landmarks  #landmarks by 3, see FaceMeasurer
  double cost(const Positions& landmarks) const;
  /// Adds a face to the crowd.
  void add(const Positions& landmarks);

 private:
  static constexpr std::size_t kBins = 256;
  struct Trait {
    TraitTarget target;
    /// for each bin: the number of faces in this and all lower bins, minus the number requested
    std::vector<double> excess;
    /// for each bin: the sum of the squared differences if a face in this bin joins the crowd
    std::vector<double> squared_differences;
  };
  static std::size_t bin_of(const TraitTarget& target, const Positions& landmarks);
  static void update_squared_differences(Trait& trait);

  std::vector<Trait> traits_;
};

}  // namespace crowdface
