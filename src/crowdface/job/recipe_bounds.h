// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// What a config may ask for and a plan may hold, either sign: far beyond anything that looks like a
/// face, and near enough for all that is computed from it to stay finite.
inline constexpr double kMaxPlaneCoordinate = 1e6;  ///< of a position on the weight plane
inline constexpr double kMaxExtrapolation = 4;      ///< the factor of Fig. 6

}  // namespace crowdface
