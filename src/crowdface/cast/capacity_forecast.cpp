// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/capacity_forecast.h"

#include "crowdface/core/require.h"

namespace crowdface {
namespace {

/// N·C where first fit ended: 1.6 to 6.5 in crowds of 360 to 7,700 faces (docs/casting.md).
constexpr double kFacesTimesChance = 4;
constexpr std::uint64_t kFewestPlaced = 256;
constexpr std::uint64_t kFewestTooNear = 100;

}  // namespace

void CapacityForecast::add(std::uint64_t too_near, std::uint64_t wanted) {
  require(wanted > 0, "a face is chosen from at least one candidate");
  pairs_ += static_cast<double>(placed_);
  chances_ += static_cast<double>(too_near) / static_cast<double>(too_near + wanted);
  too_near_ += too_near;
  ++placed_;
}

std::optional<double> CapacityForecast::faces() const {
  if (placed_ < kFewestPlaced || too_near_ < kFewestTooNear) return std::nullopt;
  return kFacesTimesChance * pairs_ / chances_;
}

}  // namespace crowdface
