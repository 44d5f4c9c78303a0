// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace crowdface {

// Largest and smallest values that configs and plans may contain. They are far beyond the values of
// any face that looks human.

/// largest absolute value of a coordinate on the weight plane
inline constexpr double kMaxPlaneCoordinate = 1e6;
/// largest absolute value of e_k, the extrapolation factor of Fig. 6
inline constexpr double kMaxExtrapolation = 4;
inline constexpr double kMaxAsymmetry = 4;  ///< largest asymmetry factor; the smallest is 0
/// largest weight of a head before normalisation
inline constexpr double kMaxSourceWeight = 1e6;
/// largest number of smoothing iterations that a config or plan may contain
inline constexpr std::uint64_t kMaxIterations = 10'000'000;

}  // namespace crowdface
