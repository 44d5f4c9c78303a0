// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/capacity_forecast.h"

#include "crowdface/core/require.h"

namespace crowdface {
namespace {

/// The number of faces at which first-fit casting ends, times C (see CapacityForecast). Measured
/// values are 1.6 to 6.5, in crowds of 360 to 7,700 faces (docs/method.md).
constexpr double kFacesTimesChance = 4;
constexpr std::uint64_t kMinPlaced = 256;
/// The forecast compares the last two complete ranges of faces (see CapacityForecast). In the
/// earlier range, at least this many candidates must have been too near to the crowd.
constexpr std::uint64_t kMinTooNear = 100;

}  // namespace

void CapacityForecast::add(std::uint64_t too_near_count, std::uint64_t far_enough_count) {
  require(far_enough_count > 0, "a face is chosen from at least one candidate");
  if (placed_count_ >= current_.face_count) {
    current_.rejected_fraction_sum += static_cast<double>(too_near_count) /
                                      static_cast<double>(too_near_count + far_enough_count);
    current_.too_near_count += too_near_count;
  }
  if (++placed_count_ < 2 * current_.face_count) return;
  before_previous_ = previous_;
  previous_ = current_;
  current_ = {placed_count_};
}

std::optional<double> CapacityForecast::estimated_face_count() const {
  if (placed_count_ < kMinPlaced || before_previous_.too_near_count < kMinTooNear)
    return std::nullopt;
  const double growth =
      (previous_.mean_rejected_fraction() - before_previous_.mean_rejected_fraction()) /
      (previous_.middle_face_number() - before_previous_.middle_face_number());
  if (!(growth > 0)) return std::nullopt;
  const double placed = 2 * static_cast<double>(previous_.face_count);
  return placed + kFacesTimesChance * (1 - previous_.mean_rejected_fraction()) / growth;
}

}  // namespace crowdface
