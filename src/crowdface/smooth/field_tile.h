// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace crowdface {

/// Vertices per tile. A tile stores all its fields contiguously, so that blending reads one block
/// of memory per head.
inline constexpr std::size_t kTileVertices = 64;
/// Number of values of one field in a tile.
inline constexpr std::size_t kTileValues = 3 * kTileVertices;

/// Vertices per patch (FieldPatches); the last patch may have fewer.
inline constexpr std::size_t kPatchVertices = 128;
/// The number of values of each field in a patch is padded to a multiple of this number, so that
/// the values fill whole SIMD vectors on any instruction set.
inline constexpr std::size_t kPatchPadding = 16;

}  // namespace crowdface
