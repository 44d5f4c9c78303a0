// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/vertex_finish.h"

#include <array>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

using Eigen::Vector3d;

/// A square that looks along +Z, its texture upright.
HeadSet square() {
  HeadSet faces;
  faces.topology.vertex_count = 4;
  const std::array<std::uint32_t, 4> corners = {0, 1, 2, 3};
  faces.topology.add_face(corners, corners);
  faces.uvs.resize(4, 2);
  faces.uvs << 0, 0, 1, 0, 1, 1, 0, 1;
  return faces;
}

Positions corners_of_square() {
  Positions positions(4, 3);
  positions << 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0;
  return positions;
}

TextureLayer evenly(const LinearRgb& light) {
  TextureLayer layer;
  layer.texture_of_face = {0};
  layer.textures.push_back(
      std::make_shared<const Texture>(Texture{8, 8, std::vector<LinearRgb>(64, light)}));
  return layer;
}

const TexturePlace kMiddle{0, {0.5F, 0.5F}};

TEST(VertexFinish, NormalsLeanAsTheMapSays) {
  TextureSet texture_set;
  EXPECT_EQ(tilted_normal(texture_set, square().topology, square().uvs, kMiddle,
                          corners_of_square(), {0, 0, 1}),
            Vector3d(0, 0, 1));
  texture_set.slopes = evenly(LinearRgb(0.5F, -0.25F, 0));
  const Vector3d lean = tilted_normal(texture_set, square().topology, square().uvs, kMiddle,
                                      corners_of_square(), {0, 0, 1});
  EXPECT_LT((lean - Vector3d(0.5, -0.25, 1).normalized()).norm(), 1e-12);
  Positions turned = corners_of_square();  // a quarter to the left
  turned << 0, 0, 0, 0, 2, 0, -2, 2, 0, -2, 0, 0;
  const Vector3d other =
      tilted_normal(texture_set, square().topology, square().uvs, kMiddle, turned, {0, 0, 1});
  EXPECT_LT((other - Vector3d(0.25, 0.5, 1).normalized()).norm(), 1e-12);
  EXPECT_EQ(tilted_normal(texture_set, square().topology, square().uvs, {}, turned, {0, 1, 0}),
            Vector3d(0, 1, 0))
      << "in no texture";
}

/// What is finer than a reduced mesh is no grain on it.
TEST(VertexFinish, FineReliefIsEvenedOut) {
  Texture stripes{512, 1, {}};
  for (int x = 0; x < 512; ++x)
    stripes.texels.push_back(LinearRgb(x % 2 == 0 ? 1.0F : -1.0F, 0, 0));
  TextureSet texture_set;
  texture_set.slopes.texture_of_face = {0};
  texture_set.slopes.textures.push_back(std::make_shared<const Texture>(std::move(stripes)));
  const TexturePlace on_stripe{0, {256.5F / 512, 0.5F}};
  const Vector3d lean = tilted_normal(texture_set, square().topology, square().uvs, on_stripe,
                                      corners_of_square(), {0, 0, 1});
  EXPECT_LT(std::abs(lean.x()), 0.4) << "a stripe alone leans by 0.7";
}

TEST(VertexFinish, RoughnessIsTheMaps) {
  TextureSet texture_set;
  EXPECT_FALSE(roughness_at(texture_set, kMiddle));
  texture_set.roughness = evenly(LinearRgb(0.3F, 0, 0));
  EXPECT_FLOAT_EQ(roughness_at(texture_set, kMiddle).value(), 0.3F);
  texture_set.roughness.texture_of_face = {TextureLayer::kNone};
  EXPECT_FALSE(roughness_at(texture_set, kMiddle));
}

}  // namespace
}  // namespace crowdface
