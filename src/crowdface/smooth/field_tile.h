// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace crowdface {

/// Vertices whose numbers of all fields stand together, so that blending them reads one piece of memory
/// a head.
inline constexpr std::size_t kFieldTile = 64;
inline constexpr std::size_t kTileValues = 3 * kFieldTile;

/// Vertices of a patch of all heads' fields (FieldPatches), but of the last.
inline constexpr std::size_t kPatchVertices = 128;
/// Values of a field stand in rows of a multiple of this: whole vectors of any instruction set.
inline constexpr std::size_t kPatchStep = 16;

}  // namespace crowdface
