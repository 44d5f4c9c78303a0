// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace crowdface {

/// Forecasts how many faces can keep the minimum distance, while first-fit casting is still placing
/// faces.
///
/// p(n) is the probability that a candidate is too near to at least one of n faces. While the crowd
/// is sparse, each new face increases p by C, where C is the probability that two candidates are
/// too near to each other. First-fit casting ends at about 4/C faces (docs/method.md). Dense parts
/// of the face space fill first, and then p grows more slowly; so C is estimated from the recent
/// growth of p.
class CapacityForecast {
 public:
  /// Records how many candidates were generated for one placed face.
  ///
  /// \param too_near_count    Number of candidates that were too near to a face of the crowd.
  /// \param far_enough_count  Number of candidates that were far enough; above zero.
  void add(std::uint64_t too_near_count, std::uint64_t far_enough_count);

  /// Returns the estimated number of faces at which casting will end, accurate to a factor of about
  /// three. Returns nothing until enough faces are placed.
  std::optional<double> estimated_face_count() const;

 private:
  /// Statistics of the candidates for the faces n + 1 to 2·n, with n = `face_count`. A rejected
  /// candidate was too near to a face of the crowd.
  struct FaceRange {
    std::uint64_t face_count = 16;     ///< n, where the range has the faces n + 1 to 2·n
    std::uint64_t too_near_count = 0;  ///< number of rejected candidates for the faces of the range
    /// Each face of the range has a fraction of rejected candidates. This is the sum of these
    /// fractions over the faces that are placed so far.
    double rejected_fraction_sum = 0;
    double mean_rejected_fraction() const {
      return rejected_fraction_sum / static_cast<double>(face_count);
    }
    /// Returns the middle of the range from n to 2·n, with n = `face_count`: 1.5·n.
    double middle_face_number() const { return 1.5 * static_cast<double>(face_count); }
  };
  std::uint64_t placed_count_ = 0;  ///< number of faces that are placed so far
  FaceRange current_;               ///< statistics of the range that contains the next face
  /// statistics of the two complete ranges before `current_`
  FaceRange previous_, before_previous_;
};

}  // namespace crowdface
