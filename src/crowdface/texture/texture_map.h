// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "crowdface/texture/optical_density.h"

namespace crowdface {

/// One head's colours in one picture of the texture.
struct TextureMap {
  int width = 0;
  int height = 0;
  std::vector<Density> planes;  ///< red, green, blue: each height · width, first row on top: v = 1

  const Density* row(int channel, int y) const {
    return planes.data() + (static_cast<std::size_t>(channel) * static_cast<std::size_t>(height) +
                            static_cast<std::size_t>(y)) *
                               static_cast<std::size_t>(width);
  }
  Density* row(int channel, int y) {
    return const_cast<Density*>(static_cast<const TextureMap*>(this)->row(channel, y));
  }
};

/// A picture in linear light that is read row by row, by any thread.
struct LightRows {
  int width = 0;
  int height = 0;
  std::function<void(int y, std::span<Eigen::Array3f> texels)> row;  ///< writes `width` texels
};

/// The picture at another size: between texels along straight lines where it grows, and where it shrinks
/// each texel is the weighted mean of those around it (a tent as wide as two of the new texels). Of the
/// same size it stays as it is.
TextureMap make_texture_map(int width, int height, const LightRows& picture);

/// Its colours as 8-bit sRGB, height · width · 3.
std::vector<std::uint8_t> srgb8_of(const TextureMap& map);

}  // namespace crowdface
