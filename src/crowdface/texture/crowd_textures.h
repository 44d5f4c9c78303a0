// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "crowdface/texture/surface_texels.h"
#include "crowdface/texture/texture_map.h"

namespace crowdface {

/// The texture maps of all heads: one row per picture (image of the common layout), one column per
/// head; null if a head has no map for a picture. Each map has the size of its picture.
using HeadMaps = std::vector<std::vector<std::shared_ptr<const TextureMap>>>;

/// The textures of a crowd's heads in one common layout.
struct CrowdTextures {
  TextureLayout layout;  ///< which polygon is in which picture
  HeadMaps maps;         ///< the heads' texture maps, #pictures by #heads
};

/// One texture image of a face, blended from the heads' maps: colours, or other values such as
/// normals.
struct BlendedPicture {
  int width = 0;   ///< in texels
  int height = 0;  ///< in texels
  /// Height by width by 3, first row on top; empty if `values_16_bit` is used.
  std::vector<std::uint8_t> srgb;
  /// Height by width by `channels`, used instead of `srgb`. A number n stands for the value `low` +
  /// n · `step`. Normals are stored as x, y, z mapped to 0 … 1, as in normal map files.
  std::vector<std::uint16_t> values_16_bit = {};
  int channels = 3;                    ///< number of values per texel in `values_16_bit`
  float low = 0, step = 1.0F / 65535;  ///< see `values_16_bit`
};

}  // namespace crowdface
