// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/traits/trait_limits.h"

namespace crowdface {

/// Steers casting so that measurements of a crowd get the requested distributions. Casting chooses
/// the candidate with the smallest cost: the candidate that brings the crowd so far nearest to
/// these distributions. The cost is a sum over the measurements: the root mean square difference
/// between the crowd's and the requested cumulative distribution (after Cramér and von Mises, on a
/// grid). The terms are roots, not squares, so a distribution that the heads cannot reach does not
/// outweigh the other distributions. A choice depends on earlier faces only, so a larger crowd
/// changes no choice.
class PopulationBalance {
 public:
  explicit PopulationBalance(const std::vector<TraitTarget>& targets);

  /// Returns how far the crowd would be from the requested distributions if this face joined; only
  /// for comparing candidates.
  ///
  /// \param landmarks  #landmarks by 3, see FaceMeasurer
  double cost(const Positions& landmarks) const;
  /// Adds a face's measurements to the crowd's distributions.
  void add(const Positions& landmarks);

 private:
  static constexpr std::size_t kBins = 256;  ///< number of bins of a distribution
  /// A measurement, and the crowd's distribution so far.
  struct Trait {
    TraitTarget target;  ///< the measurement and its requested distribution
    /// for each bin: the number of faces in this bin and all lower bins, minus the number that the
    /// requested distribution has in these bins
    std::vector<double> cumulative_excess;
    /// Entry b: the sum of the squares of `cumulative_excess` over all bins, as it would be after
    /// adding one face to bin b.
    std::vector<double> squared_excess_after_adding;
  };
  /// Returns the bin of the grid that contains the face's measurement.
  static std::size_t bin_of(const TraitTarget& target, const Positions& landmarks);
  /// Computes `squared_excess_after_adding` from `cumulative_excess`.
  static void update_squared_excess(Trait& trait);

  std::vector<Trait> traits_;
};

}  // namespace crowdface
