// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "crowdface/texture/surface_texels.h"
#include "crowdface/texture/texture_map.h"

namespace crowdface {

/// What each head has in each picture of a layout: #pictures by #heads, of the pictures' sizes; null
/// where a head has nothing.
using HeadMaps = std::vector<std::vector<std::shared_ptr<const TextureMap>>>;

/// The textures of a crowd's heads, brought to one layout.
struct CrowdTextures {
  TextureLayout layout;
  HeadMaps maps;
};

/// What one face has in one picture: colours, or numbers.
struct BlendedPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> srgb;  ///< height · width · 3, first row on top
  /// Or height · width · `channels`: number = low + step · word; of normals x, y, z, 0 … 1 as in files.
  std::vector<std::uint16_t> words = {};
  int channels = 3;
  float low = 0, step = 1.0F / 65535;
};

}  // namespace crowdface
