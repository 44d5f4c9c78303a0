// SPDX-License-Identifier: Apache-2.0
#include "crowdface/bake/filtered_texture.h"

#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace crowdface::testing {
namespace {

TextureMap map_of(int size, const std::function<float(int x, int y)>& light) {
  return make_texture_map(size, size,
                          {size, size, [&](int y, std::span<Eigen::Array3f> texels) {
                             for (int x = 0; x < size; ++x) {
                               texels[static_cast<std::size_t>(x)].setConstant(light(x, y));
                             }
                           }});
}

FilteredTexture all_covered(int size, const std::function<float(int x, int y)>& light) {
  return {map_of(size, light), std::vector<bool>(static_cast<std::size_t>(size * size), true)};
}

float at(const FilteredTexture& texture, double u, double v, double across, double down) {
  return texture.mean_at({u, v}, {across, 0}, {0, -down})[0];
}

TEST(FilteredTexture, GivesTexelsAsTheyAreAtTheirCentres) {
  const auto light = [](int x, int y) {
    return 0.05F + 0.05F * static_cast<float>((3 * x + y) % 16);
  };
  const FilteredTexture texture = all_covered(16, light);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      EXPECT_NEAR(at(texture, (x + 0.5) / 16, 1 - (y + 0.5) / 16, 1.0 / 16, 1.0 / 16), light(x, y),
                  1e-3);
    }
  }
}

// Texels that each cover many of the texture's must give the mean, and not a moiré of single texels.
TEST(FilteredTexture, ManyTexelsGiveTheirMean) {
  const FilteredTexture checks =
      all_covered(1024, [](int x, int y) { return (x + y) % 2 == 0 ? 0.8F : 0.2F; });
  for (const double texels : {3.0, 5.0, 7.3, 20.0, 40.0}) {
    for (int i = 0; i < 20; ++i) {
      const double u = 0.2 + 0.0301 * i;
      EXPECT_NEAR(at(checks, u, 0.5 + 0.001 * i, texels / 1024, texels / 1024), 0.5, 0.05)
          << texels << " texels at " << u;
    }
  }
}

// A long and narrow area must not be blurred across its width.
TEST(FilteredTexture, ANarrowAreaIsNotBlurredAcross) {
  const FilteredTexture stripes =
      all_covered(256, [](int, int y) { return y % 2 == 0 ? 0.8F : 0.2F; });
  EXPECT_NEAR(at(stripes, 0.5, 1 - 100.5 / 256, 6.0 / 256, 1.0 / 256), 0.8, 1e-2);
  EXPECT_NEAR(at(stripes, 0.5, 1 - 101.5 / 256, 6.0 / 256, 1.0 / 256), 0.2, 1e-2);
}

TEST(FilteredTexture, TheBackgroundOfAnAtlasDoesNotMixIn) {
  constexpr int kSize = 64;
  std::vector<bool> covered;
  for (int i = 0; i < kSize * kSize; ++i) covered.push_back(i % kSize < 20);
  const FilteredTexture texture(map_of(kSize, [](int x, int) { return x < 20 ? 0.6F : 0.0F; }),
                                covered);
  for (const double texels : {1.0, 2.0, 4.0, 16.0}) {
    EXPECT_NEAR(at(texture, 19.8 / kSize, 0.5, texels / kSize, texels / kSize), 0.6, 1e-3)
        << texels;
  }
  EXPECT_NEAR(at(texture, 60.5 / kSize, 0.5, 1.0 / kSize, 1.0 / kSize), 0, 1e-3);  // nothing near
}

// Linear interpolation at the middle between texels leaves a third of the finest band's energy.
TEST(FilteredTexture, DetailStaysSharpBetweenTexels) {
  constexpr int kSize = 256;
  const auto wave = [](double x) { return 0.5 + 0.3 * std::sin(2 * M_PI * x / 4); };
  const FilteredTexture texture =
      all_covered(kSize, [&](int x, int) { return static_cast<float>(wave(x + 0.5)); });
  double energy = 0, count = 0;
  for (double x = 20; x < 230; x += 0.37) {
    const double value = at(texture, x / kSize, 0.5, 1.0 / kSize, 1.0 / kSize) - 0.5;
    energy += value * value;
    count += 1;
  }
  EXPECT_GT(energy / count / (0.3 * 0.3 / 2), 0.8);
}

}  // namespace
}  // namespace crowdface::testing
