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
  /// \param too_near    Number of candidates that were too near to a face of the crowd.
  /// \param far_enough  Number of candidates that were far enough; above zero.
  void add(std::uint64_t too_near, std::uint64_t far_enough);

  /// Returns the estimated final number of faces, accurate to a factor of about three; nothing
  /// until enough faces are placed.
  std::optional<double> estimated_faces() const;

 private:
  /// Statistics of the candidates for the faces n + 1 to 2·n, with n = `face_count`.
  struct PlanSection {
    std::uint64_t face_count = 16;
    std::uint64_t too_near = 0;
    double too_near_fractions = 0;  ///< sum over the faces: fraction of candidates too near
    double mean_fraction() const { return too_near_fractions / static_cast<double>(face_count); }
    double middle_face() const { return 1.5 * static_cast<double>(face_count); }
  };
  std::uint64_t placed_ = 0;
  PlanSection current_, previous_,
      before_previous_;  ///< current range, and the two complete ranges before it
};

}  // namespace crowdface
