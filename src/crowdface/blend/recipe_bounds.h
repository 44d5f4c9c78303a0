// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace crowdface {

// Bounds of what configs and plans may ask for, far beyond anything that looks like a face.

inline constexpr double kMaxPlaneCoordinate = 1e6;  ///< of a position on the plane, either sign
inline constexpr double kMaxExtrapolation = 4;      ///< either sign; the factor of Fig. 6
inline constexpr double kMaxAsymmetry = 4;          ///< from 0
inline constexpr double kLargestWeight = 1e6;       ///< before weights are normalised
inline constexpr std::uint64_t kMaxIterations = 10'000'000;  ///< where a number of them is named

}  // namespace crowdface
