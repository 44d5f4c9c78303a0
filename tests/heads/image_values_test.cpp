// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/image_values.h"

#include <gtest/gtest.h>

namespace crowdface {
namespace {

/// All values of 8 bits, and many of 16, in each channel.
template <class Number>
Image image_of(int channels) {
  Image image{300, 41, channels, channels == 4 ? 3 : -1, std::vector<Number>()};
  auto& numbers = std::get<std::vector<Number>>(image.pixels);
  const int count = image.width * image.height * channels;
  for (int i = 0; i < count; ++i) numbers.push_back(static_cast<Number>(i * 7 + i / 256));
  return image;
}

void expect_same_with_and_without_densities(const Image& image) {
  ImageRows light = linear_light_of(image);
  ASSERT_TRUE(light.read_densities);
  const TextureMap quick = make_texture_map(image.width, image.height, light);
  light.read_densities = nullptr;
  const TextureMap plain = make_texture_map(image.width, image.height, light);
  EXPECT_EQ(quick.planes, plain.planes);
}

TEST(LightOfImage, WholeNumbersGiveTheDensitiesThatTheirLightHas) {
  for (const int channels : {1, 2, 3, 4}) {
    SCOPED_TRACE(channels);
    expect_same_with_and_without_densities(image_of<std::uint8_t>(channels));
    expect_same_with_and_without_densities(image_of<std::uint16_t>(channels));
  }
}

TEST(LightOfImage, OfFloatsLightIsAsItStands) {
  const Image image{2, 1, 3, -1, std::vector<float>{0.25F, 0.5F, 1.5F, -1, 0, 0.125F}};
  const ImageRows light = linear_light_of(image);
  EXPECT_FALSE(light.read_densities);
  std::vector<Eigen::Array3f> row(2);
  light.read_row(0, row);
  EXPECT_TRUE((row[0] == Eigen::Array3f(0.25F, 0.5F, 1.5F)).all());
  EXPECT_TRUE((row[1] == Eigen::Array3f(0, 0, 0.125F)).all());
}

}  // namespace
}  // namespace crowdface
