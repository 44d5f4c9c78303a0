// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace crowdface {

/// Foresees, while faces are placed one after the other, how many of them can keep a distance.
/// A candidate is too near to one of n faces with a chance p(n), which grows by C a face while the crowd is sparse, C being
/// the chance that two candidates are too near to each other; first fit comes to its end at some 4/C faces
/// (docs/casting.md). Where many candidates crowd together that place is full soon, and p grows slower from then on: so
/// C is what p has grown by of late.
class CapacityForecast {
 public:
  /// A face was placed.
  /// \param too_near  candidates for it that were too near to a face of the crowd
  /// \param wanted    candidates for it that were far enough, above zero
  void add(std::uint64_t too_near, std::uint64_t wanted);

  /// How many faces will fit in all, to a factor of about three; nothing while too little was seen.
  std::optional<double> faces() const;

 private:
  /// Faces number `begin` to 2·`begin`.
  struct Stretch {
    std::uint64_t begin = 16;
    std::uint64_t too_near = 0;
    double chances = 0;  ///< of being too near, summed over its faces
    double mean() const { return chances / static_cast<double>(begin); }
    double middle() const { return 1.5 * static_cast<double>(begin); }
  };
  std::uint64_t placed_ = 0;
  Stretch now_, last_, before_;  ///< the two before `now_`, which are whole
};

}  // namespace crowdface
