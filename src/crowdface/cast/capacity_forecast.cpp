// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/capacity_forecast.h"

#include "crowdface/core/require.h"

namespace crowdface {
namespace {

/// C (see CapacityForecast) times the number of faces at which first fit ends. Measured values are
/// 1.6 to 6.5, in crowds of 360 to 7,700 faces (docs/method.md).
constexpr double kFacesTimesChance = 4;
constexpr std::uint64_t kMinPlaced = 256;
/// required number of too-near candidates in the earlier of the last two complete stretches
constexpr std::uint64_t kMinTooNear = 100;

}  // namespace

void CapacityForecast::add(std::uint64_t too_near, std::uint64_t wanted) {
  require(wanted > 0, "a face is chosen from at least one candidate");
  if (placed_ >= current_.begin) {
    current_.chances += static_cast<double>(too_near) / static_cast<double>(too_near + wanted);
    current_.too_near += too_near;
  }
  if (++placed_ < 2 * current_.begin) return;
  second_last_ = previous_;
  previous_ = current_;
  current_ = {placed_};
}

std::optional<double> CapacityForecast::faces() const {
  if (placed_ < kMinPlaced || second_last_.too_near < kMinTooNear) return std::nullopt;
  const double growth =
      (previous_.mean() - second_last_.mean()) / (previous_.middle() - second_last_.middle());
  if (!(growth > 0)) return std::nullopt;
  const double placed = 2 * static_cast<double>(previous_.begin);
  return placed + kFacesTimesChance * (1 - previous_.mean()) / growth;
}

}  // namespace crowdface
