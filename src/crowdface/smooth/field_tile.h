// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace crowdface {

/// Vertices whose numbers of all fields stand together, so that blending them reads one piece of memory
/// a head.
inline constexpr std::size_t kFieldTile = 64;
inline constexpr std::size_t kTileValues = 3 * kFieldTile;

}  // namespace crowdface
