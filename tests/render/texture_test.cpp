// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/texture.h"

#include <gtest/gtest.h>

#include "crowdface/core/require.h"
#include "crowdface/render/face_renderer.h"

namespace crowdface {
namespace {

/// 2 by 1: red, then blue.
Texture red_and_blue() {
  return {2, 1, {LinearRgb(1, 0, 0), LinearRgb(0, 0, 1)}};
}

TEST(ColourAt, IsATexelAtItsCentreAndTheMeanBetweenTwo) {
  const Texture texture = red_and_blue();
  EXPECT_TRUE(colour_at(texture, {0.25F, 0.5F}).isApprox(LinearRgb(1, 0, 0)));
  EXPECT_TRUE(colour_at(texture, {0.75F, 0.1F}).isApprox(LinearRgb(0, 0, 1)));
  EXPECT_TRUE(colour_at(texture, {0.5F, 0.9F}).isApprox(LinearRgb(0.5F, 0, 0.5F)));
}

TEST(ColourAt, ClampsAtTheEdgeAndIsTheSameInEveryTile) {
  const Texture texture = red_and_blue();
  EXPECT_TRUE(colour_at(texture, {0.01F, 0.5F}).isApprox(LinearRgb(1, 0, 0)));
  EXPECT_TRUE(colour_at(texture, {3.01F, 7.5F}).isApprox(LinearRgb(1, 0, 0)));
  EXPECT_TRUE(colour_at(texture, {-0.01F, 0.5F}).isApprox(LinearRgb(0, 0, 1)));
}

TEST(ColourAt, TheFirstRowIsOnTop) {
  const Texture texture{1, 2, {LinearRgb(1, 1, 1), LinearRgb(0, 0, 0)}};
  EXPECT_GT(colour_at(texture, {0.5F, 0.8F})[0], colour_at(texture, {0.5F, 0.2F})[0]);
}

TEST(SpreadColours, FillsFromTheBorderOutwardsAndLeavesWhatIsPainted) {
  const LinearRgb red(1, 0, 0), blue(0, 0, 1), black = LinearRgb::Zero();
  Texture row{6, 1, {red, black, black, black, black, blue}};
  const std::vector<bool> painted = {true, false, false, false, false, true};
  spread_colours(row, painted, 1);
  EXPECT_TRUE(row.texels[1].isApprox(red));
  EXPECT_TRUE(row.texels[2].isZero());
  EXPECT_TRUE(row.texels[4].isApprox(blue));
  EXPECT_TRUE(row.texels[0].isApprox(red) && row.texels[5].isApprox(blue));
  spread_colours(row, painted, 4);
  EXPECT_TRUE(row.texels[2].isApprox(red) && row.texels[3].isApprox(blue));

  Texture hole{3, 3, std::vector<LinearRgb>(9, red)};
  hole.texels[4] = black;
  hole.texels[0] = blue;
  spread_colours(hole, {true, true, true, true, false, true, true, true, true}, 1);
  EXPECT_TRUE(hole.texels[4].isApprox((7 * red + blue) / 8));
}

TEST(ShrunkTexture, KeepsTheMeanAndWhatIsSmallAlready) {
  Texture texture{8, 4, {}};
  for (int i = 0; i < 32; ++i) texture.texels.push_back(LinearRgb::Constant(static_cast<float>(i)));
  const auto shrunk = [](const Texture& whole, int max_px) {
    return shrunk_texture(whole.width, whole.height, max_px,
                          [&](int y, std::span<LinearRgb> texels) {
                            std::copy_n(whole.texels.begin() + std::ptrdiff_t{y} * whole.width,
                                        whole.width, texels.begin());
                          });
  };
  const Texture small = shrunk(texture, 4);
  EXPECT_EQ(small.width, 4);
  EXPECT_EQ(small.height, 2);
  EXPECT_FLOAT_EQ(small.texels[0][0], (0 + 1 + 8 + 9) / 4.0F);
  LinearRgb sum = LinearRgb::Zero();
  for (const LinearRgb& texel : small.texels) sum += texel;
  EXPECT_FLOAT_EQ(sum[0] / 8, 15.5F);
  for (std::size_t i = 0; i < texture.texels.size(); ++i) {
    EXPECT_TRUE((shrunk(texture, 8).texels[i] == texture.texels[i]).all());
  }
  EXPECT_EQ(shrunk({5, 1, std::vector<LinearRgb>(5, LinearRgb::Ones())}, 4).width, 2);
}

/// Two squares side by side, facing the camera, each over the whole of its texture.
struct TwoSquares {
  Topology topology = {6, {0, 1, 4, 3, 1, 2, 5, 4}, {0, 1, 3, 2, 0, 1, 3, 2}, {0, 4, 8}};
  Positions positions{6, 3};
  TextureCoordinates uvs{4, 2};
  Camera camera;

  TwoSquares() {
    positions << -1, -0.5, 0, 0, -0.5, 0, 1, -0.5, 0, -1, 0.5, 0, 0, 0.5, 0, 1, 0.5, 0;
    uvs << 0, 0, 1, 0, 0, 1, 1, 1;
    const Positions* heads[] = {&positions};
    camera = fit_camera(heads, {}, View::kFront);
  }
};

TEST(FaceRenderer, TexturesColourTheFacesTheyCover) {
  const TwoSquares squares;
  Surfaces surfaces;
  surfaces.uvs = squares.uvs;
  const FaceRenderer renderer(squares.topology, {.size_px = 64}, surfaces);
  TextureSet texture_set{
      {{std::make_shared<const Texture>(red_and_blue())}, {0, TextureSet::kNone}}};
  const Rgb8Image plain = renderer.render(squares.positions, squares.camera);
  const Rgb8Image image = renderer.render(squares.positions, squares.camera, nullptr, &texture_set);
  EXPECT_GT(image.at(8, 32)[0], image.at(8, 32)[2] + 60) << "red on the left";
  EXPECT_GT(image.at(28, 32)[2], image.at(28, 32)[0] + 60) << "blue right of it";
  for (int x = 40; x < 56; ++x) {
    for (int c = 0; c < 3; ++c) EXPECT_EQ(image.at(x, 32)[c], plain.at(x, 32)[c]) << x;
  }
  texture_set.texture_of_polygon.pop_back();
  EXPECT_THROW(renderer.render(squares.positions, squares.camera, nullptr, &texture_set),
               BrokenPrecondition);
}

/// One texel that holds this everywhere.
TextureLayer everywhere(const LinearRgb& texel) {
  return {{std::make_shared<const Texture>(Texture{1, 1, {texel}})}, {0, 0}};
}

TEST(FaceRenderer, SlopesTurnTheLightAsATurnedSurfaceWould) {
  const TwoSquares squares;
  Surfaces surfaces;
  surfaces.uvs = squares.uvs;
  const FaceRenderer renderer(squares.topology, {.size_px = 64, .ambient_occlusion = false},
                              surfaces);
  const auto light = [&](const LinearRgb& slopes) {
    TextureSet texture_set{everywhere({0.3F, 0.3F, 0.3F})};
    texture_set.slopes = everywhere(slopes);
    const Rgb8Image image =
        renderer.render(squares.positions, squares.camera, nullptr, &texture_set);
    return static_cast<int>(image.at(20, 32)[0]);
  };
  // The key light comes from the upper left.
  const int flat = light({0, 0, 0});
  EXPECT_GT(light({-0.4F, 0, 0}), flat + 5) << "to the left";
  EXPECT_LT(light({0.4F, 0, 0}), flat - 5) << "to the right";
  EXPECT_GT(light({0, 0.4F, 0}), flat + 5) << "upwards";
  EXPECT_LT(light({0, -0.4F, 0}), flat - 5) << "downwards";
  // Between the key light and the eye a smooth surface shines.
  const Eigen::Vector3f half = (key_light_direction() + Eigen::Vector3f::UnitZ()).normalized();
  const auto gloss = [&](float roughness) {
    TextureSet texture_set{everywhere({0.05F, 0.05F, 0.05F})};
    texture_set.slopes = everywhere({half.x() / half.z(), half.y() / half.z(), 0});
    texture_set.roughness = everywhere({roughness, 0, 0});
    const Rgb8Image image =
        renderer.render(squares.positions, squares.camera, nullptr, &texture_set);
    return static_cast<int>(image.at(20, 32)[0]);
  };
  EXPECT_GT(gloss(0.3F), gloss(0.5F) + 10);
  EXPECT_GT(gloss(0.5F), gloss(0.8F) + 3);
}

}  // namespace
}  // namespace crowdface
