// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace crowdface {

/// Forecasts, while first fit places faces, how many faces can keep the minimum distance. p(n) is
/// the probability that a candidate is too near to one of n faces. While the crowd is sparse, p
/// grows by C per face, where C is the probability that two candidates are too near to each other.
/// First fit ends at about 4/C faces (docs/method.md). Dense parts of the face space fill first,
/// and then p grows more slowly; so C is estimated from the recent growth of p.
class CapacityForecast {
 public:
  /// Counts the candidates for one placed face.
  ///
  /// \param too_near  Number of candidates that were too near to a face of the crowd.
  /// \param wanted    Number of candidates that were far enough; above zero.
  void add(std::uint64_t too_near, std::uint64_t wanted);

  /// Returns the estimated final number of faces, accurate to a factor of about three; nothing
  /// until enough faces are placed.
  std::optional<double> faces() const;

 private:
  /// Statistics of the candidates for faces number `begin` to 2·`begin`.
  struct Stretch {
    std::uint64_t begin = 16;
    std::uint64_t too_near = 0;
    double chances = 0;  ///< sum over these faces: fraction of candidates that were too near
    double mean() const { return chances / static_cast<double>(begin); }
    double middle() const { return 1.5 * static_cast<double>(begin); }
  };
  std::uint64_t placed_ = 0;
  Stretch current_, previous_,
      second_last_;  ///< current stretch, and the two complete stretches before it
};

}  // namespace crowdface
