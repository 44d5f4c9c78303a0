// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace crowdface {

/// Foresees, while faces are placed one after the other, how many of them can keep a distance.
/// While the crowd is sparse a candidate is too near to one of n faces with a chance of n·C, where C
/// is the chance that two candidates are; first fit comes to its end at some 4/C faces (docs/casting.md).
class CapacityForecast {
 public:
  /// A face was placed.
  /// \param too_near  candidates for it that were too near to a face of the crowd
  /// \param wanted    candidates for it that were far enough, above zero
  void add(std::uint64_t too_near, std::uint64_t wanted);

  /// How many faces will fit in all, to a factor of about three; nothing while too little was seen.
  std::optional<double> faces() const;

 private:
  std::uint64_t placed_ = 0;
  std::uint64_t too_near_ = 0;
  double chances_ = 0;  ///< of being too near, summed over the faces placed
  double pairs_ = 0;    ///< Σ n, the faces that each was compared with
};

}  // namespace crowdface
