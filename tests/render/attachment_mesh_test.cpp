// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/attachment_mesh.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

#include <gtest/gtest.h>

#include "crowdface/core/random.h"
#include "crowdface/render/camera.h"
#include "crowdface/render/face_renderer.h"

#include "support/meshes.h"

namespace crowdface {
namespace {

/// A wall that looks at the camera, and a card before its middle.
struct Scene {
  Topology wall = testing::grid_topology(8, 8);
  Positions wall_points{81, 3};
  Topology card = testing::make_topology(4, {{0, 1, 2, 3}});
  Positions card_points{4, 3};
  TextureCoordinates uvs{4, 2};
  Camera camera;

  Scene() {
    for (Index v = 0; v < 81; ++v) {
      const auto row = static_cast<double>(v / 9), column = static_cast<double>(v % 9);
      wall_points.row(v) << column - 4, row - 4, 0;
    }
    card_points << -1, -1, 0.2, 1, -1, 0.2, 1, 1, 0.2, -1, 1, 0.2;
    uvs << 0, 0, 1, 0, 1, 1, 0, 1;
    card.corner_uvs = {0, 1, 2, 3};
    const Positions* walls[] = {&wall_points};
    camera = fit_camera(walls, {}, View::kFront);
  }
  Rgb8Image wearing(const std::vector<AttachmentMesh>& attachments) const {
    const FaceRenderer renderer(wall, {.size_px = 64}, {}, &wall_points);
    return renderer.render(wall_points, camera, nullptr, nullptr, attachments);
  }
  Rgb8Image render(const AttachmentMaterial& material) const {
    const AttachmentSurface surface(card, uvs, {material}, {0});
    return wearing({{&surface, &card_points}});
  }
};

/// The mean of the red channel around the middle of the picture.
double middle_red(const Rgb8Image& image) {
  double sum = 0;
  for (int y = 28; y < 36; ++y) {
    for (int x = 28; x < 36; ++x) sum += image.at(x, y)[0];
  }
  return sum / 64;
}

AttachmentMaterial black(float share) {
  return {LinearRgb::Zero(), nullptr, nullptr, share};
}

TEST(AttachmentMesh, CoversWhatIsBehindItAsFarAsItIsThere) {
  const Scene scene;
  const double bare = middle_red(scene.wearing({}));
  const double covered = middle_red(scene.render(black(1)));
  EXPECT_LT(covered, bare / 2);
  const AttachmentSurface surface(scene.card, scene.uvs, {black(1)}, {0});
  Positions behind = scene.card_points;
  behind.col(2).array() -= 1;
  // Pixels that a card may cover get more samples, so that the last digit may differ
  const Rgb8Image absent = scene.render(black(0)), hidden = scene.wearing({{&surface, &behind}});
  for (std::size_t i = 0; i < absent.pixels.size(); ++i) {
    ASSERT_NEAR(absent.pixels[i], hidden.pixels[i], 1) << i;
  }
  double before = bare;
  for (const float share : {0.25F, 0.5F, 0.75F, 1.0F}) {
    const double now = middle_red(scene.render(black(share)));
    EXPECT_LT(now, before - (bare - covered) / 8) << share;
    before = now;
  }
}

TEST(AttachmentMesh, HasHolesWhereItsTextureSaysSo) {
  const Scene scene;
  Texture left{2, 1, {LinearRgb::Ones(), LinearRgb::Zero()}};
  AttachmentMaterial material = black(1);
  material.opacity = std::make_shared<const MipMap>(left);
  const Rgb8Image bare = scene.wearing({}), half = scene.render(material);
  EXPECT_LT(half.at(28, 32)[0], bare.at(28, 32)[0] / 2) << "the left half is there";
  EXPECT_GT(half.at(37, 32)[0], bare.at(37, 32)[0] / 2) << "the right half is not";
}

// Strands that are narrower than a pixel gave dots.
TEST(AttachmentMesh, AveragesTheOpacityBehindAPixel) {
  const Scene scene;
  Texture noise{256, 256, {}};
  for (std::uint64_t t = 0; t < 256 * 256; ++t) {
    noise.texels.push_back(
        LinearRgb::Constant(random_uniform({1, t, "noise"}) < 0.5 ? 1.0F : 0.0F));
  }
  AttachmentMaterial material = black(1);
  material.opacity = std::make_shared<const MipMap>(std::move(noise));
  const Rgb8Image image = scene.render(material), half = scene.render(black(0.5F));
  for (int y = 28; y < 36; ++y) {
    for (int x = 28; x < 36; ++x) {
      EXPECT_NEAR(image.at(x, y)[0], half.at(x, y)[0], 20) << x << ' ' << y;
    }
  }
}

TEST(MipMap, KeepsTheMean) {
  Texture texture{8, 6, {}};
  for (std::uint64_t t = 0; t < 48; ++t) {
    texture.texels.push_back(
        LinearRgb::Constant(static_cast<float>(random_uniform({2, t, "texel"}))));
  }
  const auto mean = [](const Texture& level) {
    return std::accumulate(level.texels.begin(), level.texels.end(), 0.0,
                           [](double sum, const LinearRgb& texel) { return sum + texel[0]; }) /
           static_cast<double>(level.texels.size());
  };
  const MipMap map(texture);
  ASSERT_EQ(map.levels.size(), 3U);
  EXPECT_EQ(map.levels[1].width, 4);
  EXPECT_EQ(map.levels[1].height, 3);
  EXPECT_EQ(map.levels[2].width, 2);
  EXPECT_EQ(map.levels[2].height, 1);
  EXPECT_NEAR(mean(map.levels[1]), mean(texture), 1e-6);
  EXPECT_NEAR(
      (map.levels[1].texels[0][0]),
      (texture.texels[0] + texture.texels[1] + texture.texels[8] + texture.texels[9])[0] / 4, 1e-6);
}

TEST(AttachmentMesh, BearsTheColoursOfItsTexture) {
  const Scene scene;
  AttachmentMaterial material = black(1);
  material.texture =
      std::make_shared<const Texture>(Texture{1, 1, {LinearRgb(0.8F, 0.05F, 0.05F)}});
  const Rgb8Image image = scene.render(material);
  EXPECT_GT(image.at(32, 32)[0], 2 * image.at(32, 32)[1]);
}

TEST(AttachmentMesh, LooksAlikeFromBothSides) {
  const Scene scene;
  const AttachmentSurface surface(scene.card, scene.uvs, {AttachmentMaterial()}, {0});
  Topology turned = scene.card;
  std::reverse(turned.corner_vertices.begin(), turned.corner_vertices.end());
  const AttachmentSurface other(turned, scene.uvs, {AttachmentMaterial()}, {0});
  const double front = middle_red(scene.wearing({{&surface, &scene.card_points}}));
  const double back = middle_red(scene.wearing({{&other, &scene.card_points}}));
  EXPECT_NEAR(front, back, 3);
}

TEST(AttachmentMesh, CastsShadowsButThroughItsHoles) {
  Scene scene;
  scene.card_points.col(2).setConstant(1.0);
  const auto darkest = [&](const Rgb8Image& image, const Rgb8Image& bare) {
    int most = 0;  // beside the card itself, down to the right, where the key light casts
    for (int y = 36; y < 52; ++y) {
      for (int x = 40; x < 52; ++x) most = std::max(most, bare.at(x, y)[0] - image.at(x, y)[0]);
    }
    return most;
  };
  const Rgb8Image bare = scene.wearing({});
  EXPECT_GT(darkest(scene.render(black(1)), bare), 30);
  EXPECT_LT(darkest(scene.render(black(0)), bare), 1);
}

/// A card seen through a hole in another before it, which keeps the light off it: what falls on its other
/// side comes through, unless something lies there, too.
TEST(AttachmentMesh, LetsLightThroughWhereItIsDark) {
  const Scene scene;
  const auto at = [&](double scale, double z) {
    Positions points = scale * scene.card_points;
    points.col(2).setConstant(z);
    return points;
  };
  const Positions card_points = at(1, 1.5), shade_points = at(1.5, 2.1),
                  behind_points = at(1, 1.49);
  Texture hole{15, 15, std::vector<LinearRgb>(225, LinearRgb::Ones())};
  for (const std::size_t t : {96, 97, 98, 111, 112, 113, 126, 127, 128}) {
    hole.texels[t] = LinearRgb::Zero();
  }
  AttachmentMaterial shading = black(1);
  shading.opacity = std::make_shared<const MipMap>(hole);
  const AttachmentSurface card(scene.card, scene.uvs, {AttachmentMaterial()}, {0});
  const AttachmentSurface shade(scene.card, scene.uvs, {shading}, {0});
  const AttachmentSurface behind(scene.card, scene.uvs, {black(1)}, {0});
  std::vector<AttachmentMesh> attachments = {{&card, &card_points}, {&shade, &shade_points}};
  const int through = scene.wearing(attachments).at(32, 32)[0];
  attachments.push_back({&behind, &behind_points});
  EXPECT_GT(through, scene.wearing(attachments).at(32, 32)[0] + 5);
}

// Hair scatters: what is white is not black at the bottom of a shaft of it either.
TEST(AttachmentMesh, IsNotBlackWhereNoLightArrives) {
  const Scene scene;
  const Topology shaft = testing::make_topology(
      8, {{0, 1, 2, 3}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
  Positions points(8, 3);
  points << -0.6, -0.6, 0.05, 0.6, -0.6, 0.05, 0.6, 0.6, 0.05, -0.6, 0.6, 0.05,  //
      -0.6, -0.6, 2.4, 0.6, -0.6, 2.4, 0.6, 0.6, 2.4, -0.6, 0.6, 2.4;
  const auto red = [&](float colour) {
    const AttachmentSurface surface(shaft, {}, {{LinearRgb::Constant(colour)}}, {0, 0, 0, 0, 0});
    return middle_red(scene.wearing({{&surface, &points}}));
  };
  EXPECT_GT(red(0.8F), 50);
  EXPECT_LT(red(0.8F), 110);
  EXPECT_LT(red(0), 5);
}

TEST(AttachmentMesh, IsTheSamePictureEachTime) {
  const Scene scene;
  EXPECT_EQ(scene.render(black(0.4F)).pixels, scene.render(black(0.4F)).pixels);
}

}  // namespace
}  // namespace crowdface
