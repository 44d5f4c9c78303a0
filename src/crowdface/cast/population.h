// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/traits/trait_limits.h"

namespace crowdface {

/// Steers casting so that measurements of a crowd have asked distributions. Chooses the candidate
/// that brings the crowd so far nearest to these distributions: the sum over the traits of the root
/// mean square differences between both cumulative distributions (after Cramér and von Mises, on a
/// grid) is smallest. Roots keep a distribution that the heads cannot reach from
/// outweighing the others. A choice depends on earlier faces only, so a larger crowd changes none.
class PopulationBalance {
 public:
  explicit PopulationBalance(const std::vector<TraitTarget>& targets);

  /// Returns how far the crowd would be from the asked distributions with this face; for comparing
  /// candidates only. \param landmarks  #landmarks by 3, see FaceMeasurer
  double cost(const Positions& landmarks) const;
  /// Adds a face to the crowd.
  void add(const Positions& landmarks);

 private:
  static constexpr std::size_t kBins = 256;
  struct Trait {
    TraitTarget target;
    /// number of faces up to each bin minus the number that is asked for
    std::vector<double> excess;
    /// the sum of the squared differences if a face joins each bin
    std::vector<double> squares;
  };
  static std::size_t bin_of(const TraitTarget& target, const Positions& landmarks);
  static void find_squares(Trait& trait);

  std::vector<Trait> traits_;
};

}  // namespace crowdface
