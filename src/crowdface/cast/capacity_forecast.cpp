// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/capacity_forecast.h"

#include "crowdface/core/require.h"

namespace crowdface {
namespace {

/// The product of C and the number of faces at which first fit ends. Measured values are 1.6 to
/// 6.5, in crowds of 360 to 7,700 faces (docs/method.md).
constexpr double kFacesTimesChance = 4;
constexpr std::uint64_t kMinPlaced = 256;
/// smallest number of near candidates in the earlier of the two complete stretches
constexpr std::uint64_t kMinTooNear = 100;

}  // namespace

void CapacityForecast::add(std::uint64_t too_near, std::uint64_t wanted) {
  require(wanted > 0, "a face is chosen from at least one candidate");
  if (placed_ >= now_.begin) {
    now_.chances += static_cast<double>(too_near) / static_cast<double>(too_near + wanted);
    now_.too_near += too_near;
  }
  if (++placed_ < 2 * now_.begin) return;
  before_ = last_;
  last_ = now_;
  now_ = {placed_};
}

std::optional<double> CapacityForecast::faces() const {
  if (placed_ < kMinPlaced || before_.too_near < kMinTooNear) return std::nullopt;
  const double growth = (last_.mean() - before_.mean()) / (last_.middle() - before_.middle());
  if (!(growth > 0)) return std::nullopt;
  const double placed = 2 * static_cast<double>(last_.begin);
  return placed + kFacesTimesChance * (1 - last_.mean()) / growth;
}

}  // namespace crowdface
