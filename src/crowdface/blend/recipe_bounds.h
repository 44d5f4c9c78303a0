// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace crowdface {

// Limits of values in configs and plans, far beyond anything that looks like a face.

inline constexpr double kMaxPlaneCoordinate = 1e6;  ///< absolute value of a plane coordinate
inline constexpr double kMaxExtrapolation = 4;      ///< absolute value of e_k, the factor of Fig. 6
inline constexpr double kMaxAsymmetry = 4;          ///< largest asymmetry factor; the smallest is 0
/// largest weight of a head before normalisation
inline constexpr double kLargestWeight = 1e6;
/// largest number of iterations that a config or plan may give
inline constexpr std::uint64_t kMaxIterations = 10'000'000;

}  // namespace crowdface
