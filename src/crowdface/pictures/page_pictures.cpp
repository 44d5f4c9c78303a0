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

/// Returns a texture as the data URL of a JPEG file.
/// \param texel_of  returns the three bytes of a texel
template <class TexelOf>
std::string jpeg_address(const Texture& texture, int max_px, const TexelOf& texel_of) {
  const bool fits = std::max(texture.width, texture.height) <= max_px;
  const Texture small = fits ? Texture() : small_texture(texture, max_px);
  const Texture& shown = fits ? texture : small;
  std::vector<std::uint8_t> pixels;
  pixels.reserve(3 * shown.texels.size());
  for (const LinearRgb& texel : shown.texels) {
    const auto bytes = texel_of(texel);
    pixels.insert(pixels.end(), bytes.begin(), bytes.end());
  }
  return address_of("jpeg", encode_jpeg(shown.width, shown.height, pixels));
}

}  // namespace

std::uint8_t srgb_byte(float light) {
  // A table has the sRGB byte for kSteps values of linear light. The steps are equal in the square
  // root of the light, because the square root resembles the sRGB curve.
  constexpr std::size_t kSteps = 4096;
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

std::array<std::uint8_t, 3> normal_texel(const LinearRgb& slopes) {
  const Eigen::Vector3f normal = Eigen::Vector3f(slopes[0], slopes[1], 1).normalized();
  std::array<std::uint8_t, 3> texel{};
  for (std::size_t c = 0; c < 3; ++c) {
    texel[c] = static_cast<std::uint8_t>(std::lround(127.5F * (1 + normal[static_cast<Index>(c)])));
  }
  return texel;
}

std::string colour_picture(const Texture& texture, int max_px) {
  return jpeg_address(texture, max_px, [](const LinearRgb& light) {
    return std::array{srgb_byte(light[0]), srgb_byte(light[1]), srgb_byte(light[2])};
  });
}

std::string normal_picture(const Texture& slopes, int max_px) {
  return jpeg_address(slopes, max_px, normal_texel);
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
