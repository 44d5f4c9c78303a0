// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/plain_png.h"

#include <vector>

#include <gtest/gtest.h>

#include "crowdface/core/require.h"
#include "crowdface/io/image.h"

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

TEST(PlainPng, IsReadBackByAnotherLibrary) {
  constexpr int kWidth = 7, kHeight = 5;
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < 3 * kWidth * kHeight; ++i) {
    pixels.push_back(static_cast<std::uint8_t>(37 * i + 250));
  }
  const testing::TemporaryFolder folder;
  const Image image = read_image(folder.write("p.png", plain_png(kWidth, kHeight, pixels)));
  EXPECT_EQ(image.width, kWidth);
  EXPECT_EQ(image.height, kHeight);
  EXPECT_EQ(image.channels, 3);
  EXPECT_EQ(std::get<std::vector<std::uint8_t>>(image.pixels), pixels);
}

TEST(PlainPng, IsSmall) {
  EXPECT_THROW(plain_png(2, 2, std::vector<std::uint8_t>(11)), BrokenPrecondition);
  EXPECT_THROW(plain_png(256, 256, std::vector<std::uint8_t>(256 * 256 * 3)), BrokenPrecondition);
}

}  // namespace
}  // namespace crowdface
