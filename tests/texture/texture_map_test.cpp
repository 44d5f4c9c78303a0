// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/texture_map.h"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

/// Columns of light that are the number of the column, scaled, whatever the row.
ImageRows ramp(int width, int height) {
  return {width, height, [width](int, std::span<Eigen::Array3f> texels) {
            for (int x = 0; x < width; ++x) {
              texels[static_cast<std::size_t>(x)] = Eigen::Array3f::Constant(
                  (static_cast<float>(x) + 0.5F) / static_cast<float>(width));
            }
          }};
}

TEST(TextureMap, OfTheSameSizeIsThePictureItself) {
  const TextureMap map = make_texture_map(8, 3, ramp(8, 3));
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 8; ++x) {
      EXPECT_EQ(map.row(2, y)[x], density_of_light((static_cast<float>(x) + 0.5F) / 8));
    }
  }
}

TEST(TextureMap, OfAnotherSizeKeepsARamp) {
  for (const int width : {4, 7, 16, 33}) {
    const TextureMap map = make_texture_map(width, 5, ramp(16, 9));
    for (int x = 2; x + 2 < width; ++x) {
      EXPECT_NEAR(light_of_density(map.row(0, 1)[x]),
                  (static_cast<float>(x) + 0.5F) / static_cast<float>(width), 3e-3F)
          << width;
    }
  }
}

TEST(TextureMap, OfHalfTheSizeHasTheMeanLight) {
  const ImageRows checkers{
      64, 64, [](int y, std::span<Eigen::Array3f> texels) {
        for (std::size_t x = 0; x < texels.size(); ++x) {
          texels[x] = Eigen::Array3f::Constant((static_cast<int>(x) + y) % 2 == 0 ? 0.0F : 1.0F);
        }
      }};
  const TextureMap map = make_texture_map(32, 32, checkers);
  for (int x = 1; x < 31; ++x) EXPECT_NEAR(light_of_density(map.row(1, 7)[x]), 0.5F, 1e-3F);
}

}  // namespace
}  // namespace crowdface
