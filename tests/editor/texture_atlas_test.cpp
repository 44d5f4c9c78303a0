// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/texture_atlas.h"

#include <cmath>

#include <gtest/gtest.h>

#include "crowdface/io/image.h"
#include "crowdface/region/region_weights.h"

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

std::shared_ptr<const Texture> plain(const LinearRgb& colour) {
  return std::make_shared<const Texture>(Texture{32, 32, std::vector<LinearRgb>(1024, colour)});
}

const LinearRgb kRed(1, 0, 0), kGreen(0, 1, 0), kBlue(0, 0, 1);

/// Three quads in three tiles side by side; the first head has a picture for each, the second one for the
/// last two, the third none.
Inputs three_tiles() {
  Inputs inputs;
  HeadSet& head_set = inputs.head_set;
  head_set.uvs.resize(12, 2);
  for (std::uint32_t tile = 0; tile < 3; ++tile) {
    const std::uint32_t first = 4 * tile;
    for (std::uint32_t c = 0; c < 4; ++c) {
      head_set.uvs.row(first + c) << tile + (c == 1 || c == 2 ? 1.0 : 0.0), c < 2 ? 0.0 : 1.0;
    }
    const std::array<std::uint32_t, 4> corners = {first, first + 1, first + 2, first + 3};
    head_set.topology.add_face(corners, corners);
  }
  head_set.topology.vertex_count = 12;
  constexpr std::uint32_t kNone = TextureSet::kNone;
  inputs.textures.texture_sets = {{{{plain(kRed), plain(kGreen), plain(kBlue)}, {0, 1, 2}}},
                                  {{{plain(kGreen)}, {kNone, 0, 0}}},
                                  {{{}, {kNone, kNone, kNone}}}};
  return inputs;
}

class TextureAtlasTest : public ::testing::Test {
 protected:
  /// What a page shows in the middle and near the corners of a face.
  void expect_colour(Index head, Index face, const LinearRgb& colour) {
    const testing::TemporaryFolder folder;
    ImageLimits limits;
    limits.allows_jpeg = true;
    const Image picture =
        read_image(folder.write("atlas.jpg", *TextureAtlas(inputs_).head_jpeg(head)), limits);
    const TextureCoordinates uvs = TextureAtlas(inputs_).coordinates();
    Eigen::RowVector2d middle = Eigen::RowVector2d::Zero();
    for (const std::uint32_t uv : inputs_.head_set.topology.face_uvs(face))
      middle += uvs.row(uv) / 4;
    for (const std::uint32_t uv : inputs_.head_set.topology.face_uvs(face)) {
      for (const double way : {0.0, 0.9}) {
        const Eigen::RowVector2d at = middle + way * (uvs.row(uv) - middle);
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(sample_bilinear(picture, at[0], at[1], c), colour[c], 0.1)
              << face << ' ' << at;
        }
      }
    }
  }
  Inputs inputs_ = three_tiles();
};

TEST_F(TextureAtlasTest, EachTileLiesInACellOfItsOwn) {
  expect_colour(0, 0, kRed);
  expect_colour(0, 1, kGreen);
  expect_colour(0, 2, kBlue);
}

TEST_F(TextureAtlasTest, AHeadWithOtherFilesHasThemAtTheSamePlaces) {
  expect_colour(1, 1, kGreen);
  expect_colour(1, 2, kGreen);
}

TEST_F(TextureAtlasTest, AHeadWithoutTexturesHasNoPicture) {
  const TextureAtlas atlas(inputs_);
  EXPECT_TRUE(atlas.has_textures_of(1));
  EXPECT_FALSE(atlas.has_textures_of(2));
  EXPECT_FALSE(atlas.head_jpeg(2));
}

TEST_F(TextureAtlasTest, OnePictureStaysAsItIs) {
  inputs_.textures.texture_sets = {{{{plain(kBlue)}, {0, 0, 0}}}};
  EXPECT_EQ(TextureAtlas(inputs_).coordinates(), inputs_.head_set.uvs);
  inputs_.textures.texture_sets.clear();
  EXPECT_EQ(TextureAtlas(inputs_).coordinates(), inputs_.head_set.uvs);
}

}  // namespace
}  // namespace crowdface
