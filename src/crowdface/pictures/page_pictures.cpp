// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/page_pictures.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/preview/packed_face.h"

namespace crowdface {
namespace {

Texture small_texture(const Texture& texture, int max_px) {
  return shrunk_texture(texture.width, texture.height, max_px,
                        [&](int y, std::span<LinearRgb> texels) {
                          const auto first = texture.texels.begin() + y * texture.width;
                          std::copy_n(first, texture.width, texels.begin());
                        });
}

std::string address_of(std::string_view type, std::string_view bytes) {
  return concat("data:image/", type, ";base64,", base64(bytes));
}

}  // namespace

std::uint8_t srgb_byte(float light) {
  constexpr std::size_t kSteps = 4096;  // steps of the square root, which resembles the sRGB curve
  static const std::vector<std::uint8_t> bytes = [] {
    std::vector<std::uint8_t> table;
    for (std::size_t i = 0; i < kSteps; ++i) {
      const float root = (static_cast<float>(i) + 0.5F) / kSteps;
      const float value = to_srgb(LinearRgb::Constant(root * root))[0];
      table.push_back(static_cast<std::uint8_t>(std::lround(255 * std::min(value, 1.0F))));
    }
    return table;
  }();
  const float root = std::sqrt(std::clamp(light, 0.0F, 1.0F));
  return bytes[std::min(static_cast<std::size_t>(kSteps * root), kSteps - 1)];
}

std::string colour_picture(const Texture& texture, int max_px) {
  const bool fits = std::max(texture.width, texture.height) <= max_px;
  const Texture small = fits ? Texture() : small_texture(texture, max_px);
  const Texture& shown = fits ? texture : small;
  std::vector<std::uint8_t> pixels(3 * shown.texels.size());
  std::uint8_t* at = pixels.data();
  for (const LinearRgb& light : shown.texels) {
    for (int c = 0; c < 3; ++c) *at++ = srgb_byte(light[c]);
  }
  return address_of("jpeg", encode_jpeg(shown.width, shown.height, pixels));
}

std::string opacity_picture(const Texture& texture, int max_px) {
  const Texture small = small_texture(texture, max_px);
  std::vector<std::uint8_t> pixels;
  for (const LinearRgb& there : small.texels) {
    pixels.push_back(
        static_cast<std::uint8_t>(std::lround(255 * std::clamp(there[0], 0.0F, 1.0F))));
  }
  return address_of("png", encode_png(small.width, small.height, 1, pixels));
}

}  // namespace crowdface
