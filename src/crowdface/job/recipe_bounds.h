// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace crowdface {

/// What a config may ask for and a plan may hold, either sign: far beyond anything that looks like a
/// face, and near enough for all that is computed from it to stay finite.
inline constexpr double kMaxPlaneCoordinate = 1e6;           ///< of a position on the weight plane
inline constexpr double kMaxExtrapolation = 4;               ///< the factor of Fig. 6
inline constexpr double kLargestWeight = 1e6;                ///< before weights are normalised
inline constexpr std::uint64_t kMaxIterations = 10'000'000;  ///< where a number of them is named

}  // namespace crowdface
