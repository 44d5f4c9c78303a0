// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/vertex_roughness.h"

#include <memory>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

TextureLayer evenly(const LinearRgb& light) {
  TextureLayer layer;
  layer.texture_of_polygon = {0};
  layer.textures.push_back(
      std::make_shared<const Texture>(Texture{8, 8, std::vector<LinearRgb>(64, light)}));
  return layer;
}

const TexturePoint kMiddle{0, {0.5F, 0.5F}};

/// What is finer than a reduced mesh is no grain on it.
TEST(VertexFinish, FineRoughnessIsEvenedOut) {
  Texture stripes{512, 1, {}};
  for (int x = 0; x < 512; ++x) stripes.texels.push_back(LinearRgb(x % 2 == 0 ? 1.0F : 0.0F, 0, 0));
  TextureSet texture_set;
  texture_set.roughness.texture_of_polygon = {0};
  texture_set.roughness.textures.push_back(std::make_shared<const Texture>(std::move(stripes)));
  const TexturePoint on_stripe{0, {256.5F / 512, 0.5F}};
  EXPECT_LT(roughness_at(texture_set, on_stripe).value(), 0.7F) << "a stripe alone has 1";
}

TEST(VertexFinish, RoughnessIsTheMaps) {
  TextureSet texture_set;
  EXPECT_FALSE(roughness_at(texture_set, kMiddle));
  texture_set.roughness = evenly(LinearRgb(0.3F, 0, 0));
  EXPECT_FLOAT_EQ(roughness_at(texture_set, kMiddle).value(), 0.3F);
  texture_set.roughness.texture_of_polygon = {TextureLayer::kNone};
  EXPECT_FALSE(roughness_at(texture_set, kMiddle));
}

}  // namespace
}  // namespace crowdface
