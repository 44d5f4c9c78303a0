// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/capacity_forecast.h"

#include "crowdface/core/require.h"

namespace crowdface {
namespace {

/// The number of faces at which first-fit casting ends, times C (see CapacityForecast). Measured
/// values are 1.6 to 6.5, in crowds of 360 to 7,700 faces (docs/method.md).
constexpr double kFacesTimesChance = 4;
constexpr std::uint64_t kMinPlaced = 256;
/// The forecast needs at least this many candidates that were too near, in the earlier of the last
/// two complete ranges.
constexpr std::uint64_t kMinTooNear = 100;

}  // namespace

void CapacityForecast::add(std::uint64_t too_near, std::uint64_t far_enough) {
  require(far_enough > 0, "a face is chosen from at least one candidate");
  if (placed_ >= current_.face_count) {
    current_.too_near_fractions +=
        static_cast<double>(too_near) / static_cast<double>(too_near + far_enough);
    current_.too_near += too_near;
  }
  if (++placed_ < 2 * current_.face_count) return;
  before_previous_ = previous_;
  previous_ = current_;
  current_ = {placed_};
}

std::optional<double> CapacityForecast::estimated_faces() const {
  if (placed_ < kMinPlaced || before_previous_.too_near < kMinTooNear) return std::nullopt;
  const double growth = (previous_.mean_fraction() - before_previous_.mean_fraction()) /
                        (previous_.middle_face() - before_previous_.middle_face());
  if (!(growth > 0)) return std::nullopt;
  const double placed = 2 * static_cast<double>(previous_.face_count);
  return placed + kFacesTimesChance * (1 - previous_.mean_fraction()) / growth;
}

}  // namespace crowdface
