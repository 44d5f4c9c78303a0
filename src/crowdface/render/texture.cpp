// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/texture.h"

#include <algorithm>
#include <cmath>

namespace crowdface {

Texture shrunk(Texture texture, int most_px) {
  const int longest = std::max(texture.width, texture.height);
  const int block = (longest + most_px - 1) / most_px;
  if (block <= 1) return texture;
  Texture small{std::max(1, texture.width / block), std::max(1, texture.height / block), {}};
  small.texels.reserve(static_cast<std::size_t>(small.width) *
                       static_cast<std::size_t>(small.height));
  for (int y = 0; y < small.height; ++y) {
    // Blocks of one size, or one larger where the sides are no multiples.
    const int top = y * texture.height / small.height;
    const int bottom = (y + 1) * texture.height / small.height;
    for (int x = 0; x < small.width; ++x) {
      const int left = x * texture.width / small.width;
      const int right = (x + 1) * texture.width / small.width;
      Light sum = Light::Zero();
      for (int j = top; j < bottom; ++j) {
        for (int i = left; i < right; ++i) {
          sum +=
              texture.texels[static_cast<std::size_t>(j) * static_cast<std::size_t>(texture.width) +
                             static_cast<std::size_t>(i)];
        }
      }
      small.texels.emplace_back(sum / static_cast<float>((bottom - top) * (right - left)));
    }
  }
  return small;
}

Light colour_at(const Texture& texture, const Eigen::Vector2f& uv) {
  const Eigen::Vector2f tile(std::floor(uv.x()), std::floor(uv.y()));
  const auto between = [](float place, int count) {
    return std::clamp(place * static_cast<float>(count) - 0.5F, 0.0F,
                      static_cast<float>(count - 1));
  };
  const float x = between(uv.x() - tile.x(), texture.width);
  const float y = between(1 - (uv.y() - tile.y()), texture.height);
  const int left = static_cast<int>(x);
  const int top = static_cast<int>(y);
  const int right = std::min(left + 1, texture.width - 1);
  const int bottom = std::min(top + 1, texture.height - 1);
  const auto at = [&](int i, int j) -> const Light& {
    return texture.texels[static_cast<std::size_t>(j) * static_cast<std::size_t>(texture.width) +
                          static_cast<std::size_t>(i)];
  };
  const float s = x - static_cast<float>(left);
  const float t = y - static_cast<float>(top);
  return (1 - t) * ((1 - s) * at(left, top) + s * at(right, top)) +
         t * ((1 - s) * at(left, bottom) + s * at(right, bottom));
}

}  // namespace crowdface
