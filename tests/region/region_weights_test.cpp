// SPDX-License-Identifier: Apache-2.0
#include "crowdface/region/region_weights.h"

#include <string>

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Vertices of one triangle strip, one texture coordinate each.
struct Strip {
  Topology topology;
  TextureCoordinates uvs;

  explicit Strip(const std::vector<std::array<double, 2>>& places)
      : uvs(static_cast<Index>(places.size()), 2) {
    topology.vertex_count = uvs.rows();
    for (std::uint32_t i = 0; i < places.size(); ++i) uvs.row(i) << places[i][0], places[i][1];
    for (std::uint32_t i = 0; i + 2 < places.size(); ++i) {
      for (std::uint32_t c = i; c < i + 3; ++c) {
        topology.corner_vertices.push_back(c);
        topology.corner_uvs.push_back(c);
      }
      topology.face_offsets.push_back(topology.face_offsets.back() + 3);
    }
  }
};

Image image_of(int width, int height, int channels, const std::vector<float>& pixels,
               int alpha = -1) {
  return {width, height, channels, alpha, pixels, {}};
}

std::string message_of_masks(const Strip& strip, const std::vector<MaskSource>& masks,
                             Index regions) {
  try {
    region_weights(strip.topology, strip.uvs, masks, regions);
  } catch (const RecoverableError& error) {
    return error.what();
  }
  return "accepted";
}

Strip three() {
  return Strip({{0.5, 0.5}, {0.25, 0.25}, {0.75, 0.25}});
}

TEST(SampleBilinear, TexelCentresAreExact) {
  Image image = image_of(4, 8, 1, {});
  for (int i = 0; i < 32; ++i) std::get<0>(image.pixels).push_back(0.37F * static_cast<float>(i));
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 4; ++x) {
      EXPECT_EQ(sample_bilinear(image, (x + 0.5) / 4, 1 - (y + 0.5) / 8, 0), image.at(x, y, 0));
    }
  }
}

TEST(SampleBilinear, RampIsLinearBetweenCentres) {
  const Image image = image_of(4, 1, 1, {0, 1, 2, 3});
  for (double u = 0.125; u <= 0.875; u += 0.03) {
    EXPECT_NEAR(sample_bilinear(image, u, 0.3, 0), 4 * u - 0.5, 1e-12);
  }
}

TEST(SampleBilinear, MixesFourNeighbours) {
  const Image image = image_of(2, 2, 1, {1, 2, 3, 5});
  EXPECT_DOUBLE_EQ(sample_bilinear(image, 0.5, 0.5, 0), 11.0 / 4);
}

TEST(SampleBilinear, EdgesAreClamped) {
  const Image image = image_of(2, 2, 1, {1, 2, 3, 4});
  EXPECT_EQ(sample_bilinear(image, 0, 1, 0), 1);
  EXPECT_EQ(sample_bilinear(image, 1, 0, 0), 4);
  EXPECT_EQ(sample_bilinear(image, -7, 9, 0), 1);
  EXPECT_EQ(sample_bilinear(image, 0.2, -9, 0), 3);
}

TEST(SampleBilinear, FirstRowLiesAtTheTop) {
  const Image image = image_of(1, 2, 1, {7, 8});
  EXPECT_EQ(sample_bilinear(image, 0.5, 1, 0), 7);
  EXPECT_EQ(sample_bilinear(image, 0.5, 0, 0), 8);
}

TEST(RegionWeights, WholeHeadIsAllOnes) {
  const auto weights = region_weights(three().topology, {}, {}, 1);
  EXPECT_EQ(weights.alpha, RegionWeights::Alpha::Ones(3, 1));
  EXPECT_EQ(weights.uncovered_vertex_count, 0);
}

TEST(RegionWeights, AGreyPaintingIsOneChannel) {
  const Strip strip({{0.25, 0.5}, {0.5, 0.5}, {0.75, 0.5}});
  const MaskSource one("m", image_of(2, 1, 1, {1, 0}));
  const MaskSource three_equal("m", image_of(2, 1, 3, {1, 1, 1, 0, 0, 0}));
  EXPECT_EQ(region_weights(strip.topology, strip.uvs, {three_equal}, 2).alpha,
            region_weights(strip.topology, strip.uvs, {one}, 2).alpha);
  EXPECT_THAT(message_of_masks(strip, {three_equal}, 3), HasSubstr("3 regions, found 1"));
}

TEST(RegionWeights, ConstantMasksAreScaledToOne) {
  const MaskSource mask("m", image_of(1, 1, 3, {0.5F, 0.25F, 0.25F}));
  const MaskSource doubled("m", image_of(1, 1, 3, {1.0F, 0.5F, 0.5F}));
  const auto weights = region_weights(three().topology, three().uvs, {mask}, 3);
  for (Index i = 0; i < 3; ++i) {
    EXPECT_EQ(weights.alpha.row(i), Eigen::RowVector3d(0.5, 0.25, 0.25));
  }
  EXPECT_EQ(region_weights(three().topology, three().uvs, {doubled}, 3).alpha, weights.alpha);
}

TEST(RegionWeights, RowsSumToOne) {
  Image image = image_of(5, 4, 3, {});
  for (int i = 0; i < 60; ++i)
    std::get<0>(image.pixels).push_back(static_cast<float>((i * 37) % 19) / 7);
  std::vector<std::array<double, 2>> places;
  places.reserve(200);
  for (int i = 0; i < 200; ++i) places.push_back({0.137 * i - 5, 0.731 * i});
  const Strip strip(places);
  const auto weights = region_weights(strip.topology, strip.uvs, {MaskSource("m", image)}, 3);
  for (Index i = 0; i < 200; ++i) {
    EXPECT_NEAR(weights.alpha.row(i).sum(), 1, 1e-15);
    EXPECT_GE(weights.alpha.row(i).minCoeff(), 0);
  }
}

TEST(RegionWeights, SeamVertexTakesTheMeanOfItsPlaces) {
  // Two pixels, region 0 on the left, region 1 on the right; vertex 0 lies once in each, and its
  // place on the left is named by two of its three corners.
  const MaskSource mask("m", image_of(2, 1, 2, {1, 0, 0, 1}));
  Strip strip({{0.25, 0.5}, {0.25, 0.5}, {0.75, 0.5}, {0.75, 0.5}});
  strip.topology.corner_vertices = {0, 1, 2, 0, 2, 3, 0, 3, 1};
  strip.topology.corner_uvs = {0, 1, 2, 2, 2, 3, 0, 3, 1};
  strip.topology.face_offsets = {0, 3, 6, 9};
  const auto weights = region_weights(strip.topology, strip.uvs, {mask}, 2);
  EXPECT_EQ(weights.alpha.row(0), Eigen::RowVector2d(0.5, 0.5));
  EXPECT_EQ(weights.alpha.row(1), Eigen::RowVector2d(1, 0));
  EXPECT_EQ(weights.alpha.row(3), Eigen::RowVector2d(0, 1));
}

TEST(RegionWeights, UncoveredVerticesGoToTheLastRegionAndAreCounted) {
  const MaskSource mask("m", image_of(2, 1, 2, {1, 0, 0, 0}));
  Strip strip({{0.1, 0.5}, {0.9, 0.5}, {0.8, 0.5}, {0.2, 0.5}});
  strip.topology.vertex_count = 5;  // the last is in no face
  const auto weights = region_weights(strip.topology, strip.uvs, {mask}, 2);
  EXPECT_EQ(weights.uncovered_vertex_count, 2);
  EXPECT_EQ(weights.alpha.row(0), Eigen::RowVector2d(1, 0));
  EXPECT_EQ(weights.alpha.row(1), Eigen::RowVector2d(0, 1));
  EXPECT_EQ(weights.alpha.row(4), Eigen::RowVector2d(0, 1));
}

TEST(RegionWeights, ChannelsOfSeveralImagesMakeRegionsInOrder) {
  const MaskSource first("first", image_of(1, 1, 3, {1, 2, 3}));
  const MaskSource second("second", image_of(1, 1, 3, {4, 6, 100}));  // its third is left over
  const auto weights = region_weights(three().topology, three().uvs, {first, second}, 5);
  EXPECT_TRUE(
      weights.alpha.row(2).isApprox(Eigen::Matrix<double, 1, 5>(1, 2, 3, 4, 6) / 16, 1e-15));
}

TEST(RegionWeights, AlphaIsIgnored) {
  const MaskSource mask("m", image_of(1, 1, 4, {0.5F, 0.25F, 0.25F, 0}, 3));
  EXPECT_EQ(region_weights(three().topology, three().uvs, {mask}, 3).alpha.row(0),
            Eigen::RowVector3d(0.5, 0.25, 0.25));
  EXPECT_THAT(message_of_masks(three(), {mask}, 4), HasSubstr("4 regions, found 3"));
}

Image named(Image image, const std::vector<std::string>& names) {
  image.channel_names = names;
  return image;
}

const std::vector<std::string> kThreeNames = {"top", "middle", "bottom"};

TEST(RegionWeights, ChannelsThatAreCalledLikeRegionsAreThese) {
  const auto weights = [&](const Image& image) {
    return region_weights(three().topology, three().uvs, {MaskSource("m.exr", image)}, 3, {},
                          kThreeNames);
  };
  const Image image = image_of(1, 1, 3, {1, 2, 3});
  const Eigen::RowVector3d expected = Eigen::RowVector3d(3, 2, 1) / 6;
  EXPECT_EQ(weights(named(image, {"bottom", "middle", "top"})).alpha.row(0), expected);
  EXPECT_EQ(weights(named(image, {"mask.Bottom", "mask.Middle", "mask.Top"})).alpha.row(0),
            expected);
  EXPECT_EQ(weights(named(image, {"R", "G", "B"})).alpha.row(0), Eigen::RowVector3d(1, 2, 3) / 6);
  try {
    weights(named(image, {"a", "bottom1", "other"}));
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("m.exr"), HasSubstr("bottom1"),
                                    HasSubstr("name the channels like the regions")));
  }
  try {
    weights(named(image, {"top", "bottom", "other"}));
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("middle"));
  }
}

TEST(RegionWeights, OneImageMayBeOneRegion) {
  // Grey in three channels, and colours that are the same in both, with the mask in alpha.
  const Image grey = image_of(2, 1, 3, {1, 1, 1, 0, 0, 0});
  const Image alpha = image_of(2, 1, 4, {0.2F, 0.5F, 0.1F, 0, 0.2F, 0.6F, 0.1F, 1}, 3);
  const Strip strip({{0.25, 0.5}, {0.75, 0.5}, {0.75, 0.25}});
  const auto in_order = region_weights(strip.topology, strip.uvs,
                                       {MaskSource("a/1.png", grey), MaskSource("a/2.png", alpha)},
                                       2, {}, {"brow", "lip"});
  EXPECT_EQ(in_order.alpha.row(0), Eigen::RowVector2d(1, 0));
  EXPECT_EQ(in_order.alpha.row(1), Eigen::RowVector2d(0, 1));
  const auto by_name = region_weights(
      strip.topology, strip.uvs, {MaskSource("a/lip.png", grey), MaskSource("a/brow.png", alpha)},
      2, {}, {"brow", "lip"});
  EXPECT_EQ(by_name.alpha.row(0), Eigen::RowVector2d(0, 1));
  const auto by_word = region_weights(
      strip.topology, strip.uvs,
      {MaskSource("a/mask_Lip_v2.png", grey), MaskSource("a/mask_brow_v2.png", alpha)}, 2, {},
      {"brow", "lip"});
  EXPECT_EQ(by_word.alpha, by_name.alpha);
  const Image colours = image_of(1, 1, 3, {0.1F, 0.2F, 0.3F});
  EXPECT_THAT(
      message_of_masks(strip, {MaskSource("c.png", colours), MaskSource("d.png", colours)}, 2),
      AllOf(HasSubstr("c.png"), HasSubstr("grey")));
}

TEST(RegionWeights, AlphaCountsWhereColoursTellNothingAndOneChannelLeavesARest) {
  const Image white = image_of(2, 1, 4, {1, 1, 1, 0.25F, 1, 1, 1, 1}, 3);
  const Strip strip({{0.25, 0.5}, {0.75, 0.5}, {0.75, 0.25}});
  const auto weights = region_weights(strip.topology, strip.uvs, {MaskSource("m", white)}, 2);
  EXPECT_EQ(weights.alpha.row(0), Eigen::RowVector2d(0.25, 0.75));
  EXPECT_EQ(weights.alpha.row(1), Eigen::RowVector2d(1, 0));
}

TEST(RegionWeights, RowsOfVerticesNeedNoTextureCoordinates) {
  Strip strip = three();
  strip.topology.corner_uvs.clear();
  const testing::TemporaryFolder folder;
  const auto weights = [&](const char* name, const std::string& text) {
    const std::string file = folder.write(name, text).string();
    return region_weights(strip.topology, {}, {MaskSource(file)}, 2, {}, {"face", "rest"});
  };
  const auto plain = weights("w.txt", "# painted\n1 0\n0.5 0.5\n1 3\n");
  EXPECT_EQ(plain.alpha.row(2), Eigen::RowVector2d(0.25, 0.75));
  EXPECT_EQ(weights("w.csv", "rest,face\n0,1\n.5,.5\n3,1\n").alpha, plain.alpha);
  EXPECT_EQ(weights("w.csv", "\xEF\xBB\xBFrest;face\r\n0;1\r\n0,5;0,5\r\n3;1\r\n").alpha,
            plain.alpha);
  EXPECT_EQ(weights("w.csv", "\"rest\",\"face\"\n0,1\n.5,.5\n3,1\n").alpha, plain.alpha);
  EXPECT_EQ(weights("cr.csv", "rest,face\r0,1\r.5,.5\r3,1\r").alpha, plain.alpha);
  std::string utf16 = "\xff\xfe";
  for (const char c : std::string("rest\tface\r\n0\t1\r\n.5\t.5\r\n3\t1\r\n")) utf16 += {c, '\0'};
  EXPECT_EQ(weights("u.txt", utf16).alpha, plain.alpha);
  // pandas numbers the rows from 0, R from 1.
  EXPECT_EQ(weights("w.csv", ",rest,face\n0,0,1\n1,.5,.5\n2,3,1\n").alpha, plain.alpha);
  EXPECT_EQ(weights("w.txt", "\"rest\" \"face\"\n\"1\" 0 1\n\"2\" .5 .5\n\"3\" 3 1\n").alpha,
            plain.alpha);
  EXPECT_EQ(weights("w.txt", "1 -2.8e-17\n0.5 0.5\n1 3\n").alpha, plain.alpha);
  EXPECT_EQ(plain.uncovered_vertex_count, 0);
  EXPECT_EQ(weights("w.txt", "1 0\n0 0\n0 0\n").uncovered_vertex_count, 2);
  for (const char* bad : {"1 0\n1 0\n", "1 0\n1\n1 0\n", "1 0\n-1 0\n1 0\n", "1 0\nnan 0\n1 0\n",
                          "1 0\n-0.3 0\n1 0\n", "rest,face\n0,1,0\n1,1,0\n3,1,0\n",
                          "rest,face\n5,1,0\n6,1,0\n7,1,0\n"}) {
    EXPECT_THROW(weights("bad.txt", bad), RecoverableError) << bad;
  }
}

TEST(RegionWeights, OnlyNeededVerticesNeedTextureCoordinates) {
  Strip strip({{0.5, 0.5}, {0.25, 0.25}, {0.75, 0.25}, {0, 0}});
  strip.topology.corner_uvs[5] = kNoIndex;
  const MaskSource mask("m", image_of(1, 1, 2, {1, 1}));
  EXPECT_THAT(message_of_masks(strip, {mask}, 2), HasSubstr("texture coordinate"));
  const auto weights =
      region_weights(strip.topology, strip.uvs, {mask}, 2, {true, true, true, false});
  EXPECT_EQ(weights.alpha.row(0), Eigen::RowVector2d(0.5, 0.5));
  EXPECT_EQ(weights.alpha.row(3), Eigen::RowVector2d(0, 1));
}

TEST(RegionWeights, ThreadCountChangesNothing) {
  Image image = image_of(16, 16, 3, {});
  for (int i = 0; i < 768; ++i)
    std::get<0>(image.pixels).push_back(static_cast<float>((i * 91) % 57) / 57);
  std::vector<std::array<double, 2>> places;
  places.reserve(20000);
  for (int i = 0; i < 20000; ++i) places.push_back({0.618034 * i - 0.618034 * i / 1.7, 1e-4 * i});
  const Strip strip(places);
  const auto many = region_weights(strip.topology, strip.uvs, {MaskSource("m", image)}, 3);
  const ThreadLimit one(1);
  EXPECT_EQ(many.alpha,
            region_weights(strip.topology, strip.uvs, {MaskSource("m", image)}, 3).alpha);
}

TEST(RegionWeights, ChannelCountsAreChecked) {
  const MaskSource grey("grey.png", image_of(1, 1, 1, {1}));
  EXPECT_THAT(message_of_masks(three(), {grey}, 3),
              AllOf(HasSubstr("3 regions, found 1"), HasSubstr("grey.png (1)")));
  EXPECT_THAT(message_of_masks(three(), {}, 2), HasSubstr("no image"));
  EXPECT_THAT(message_of_masks(three(), {grey, MaskSource("extra.png", image_of(1, 1, 1, {1}))}, 1),
              AllOf(HasSubstr("extra.png"), HasSubstr("remove this image")));
  EXPECT_THROW(message_of_masks(three(), {grey}, 0), BrokenPrecondition);
}

class MaskFiles : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void write(const std::string& name, const std::vector<std::uint8_t>& pixel) const {
    folder_.write(name, encode_png(1, 1, static_cast<int>(pixel.size()), pixel));
  }

  testing::TemporaryFolder folder_;
};

TEST_F(MaskFiles, TilesAreTakenByPlace) {
  write("m.1001.png", {255, 0, 0});
  write("m.1002.png", {0, 255, 0});
  write("m.1012.png", {0, 0, 255});
  // u = 1 and v = 1 are borders: each triangle's middle decides, in its own tile only.
  const std::vector<std::array<double, 2>> first = {{1, 1}, {0.5, 1}, {1, 0.5}};
  const std::vector<std::array<double, 2>> second = {{1, 1}, {1.5, 1}, {1, 0.5}};
  const std::vector<std::array<double, 2>> third = {{1, 1}, {1.5, 1}, {2, 2}};
  const MaskSource mask(path("m.<UDIM>.png"));
  Index region = 0;
  for (const auto& places : {first, second, third}) {
    const Strip strip(places);
    const auto weights = region_weights(strip.topology, strip.uvs, {mask}, 3);
    for (Index i = 0; i < 3; ++i) EXPECT_EQ(weights.alpha(i, region), 1) << region;
    ++region;
  }
}

TEST_F(MaskFiles, MissingTilesAreAllNamed) {
  write("m.1001.png", {255, 0, 0});
  const Strip strip({{0.5, 0.5}, {1.5, 0.5}, {0.5, 1.5}});
  try {
    region_weights(strip.topology, strip.uvs, {MaskSource(path("m.<UDIM>.png"))}, 3);
    FAIL() << "accepted";
  } catch (const RecoverableError& error) {
    EXPECT_EQ(error.code(), ExitCode::kMissingInput);
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("tile 1002"), HasSubstr("m.1002.png"), HasSubstr("tile 1011")));
  }
}

TEST_F(MaskFiles, TilesThatNobodyNeedsMayLack) {
  write("m.1001.png", {0, 255, 0});
  const Strip strip({{0.5, 0.5}, {1.5, 0.5}, {0.5, 0.7}});
  const std::vector<MaskSource> masks = {MaskSource(path("m.<UDIM>.png"))};
  const auto weights = region_weights(strip.topology, strip.uvs, masks, 3, {true, false, true});
  EXPECT_EQ(weights.uncovered_vertex_count, 0);
  EXPECT_EQ(weights.alpha(0, 1), 1);
  EXPECT_EQ(weights.alpha(1, 2), 1) << "the last region";
  EXPECT_THROW(region_weights(strip.topology, strip.uvs, masks, 3, {false, true, false}), Error);
}

TEST_F(MaskFiles, TilesMustAgreeInChannels) {
  write("m.1001.png", {255, 0, 0, 255});  // alpha does not count
  write("m.1002.png", {0, 255, 0});
  const Strip strip({{0.5, 0.5}, {1.5, 0.5}, {1.5, 0.7}});
  EXPECT_EQ(message_of_masks(strip, {MaskSource(path("m.<UDIM>.png"))}, 3), "accepted");
  write("m.1002.png", {255});
  EXPECT_THAT(message_of_masks(strip, {MaskSource(path("m.<UDIM>.png"))}, 3),
              HasSubstr("expected 3 channels as in tile 1001, found 1 in tile 1002"));
}

TEST_F(MaskFiles, MissingImageIsMissingInput) {
  EXPECT_THROW(region_weights(three().topology, three().uvs, {MaskSource(path("none.png"))}, 1),
               Error);
  EXPECT_THAT(message_of_masks(three(), {MaskSource(path("none.png"))}, 1), HasSubstr("none.png"));
}

TEST_F(MaskFiles, SixteenBitsAreKept) {
  OIIO::ImageSpec spec(1, 1, 2, OIIO::TypeDesc::UINT16);
  spec.alpha_channel = -1;
  const std::string file = path("deep.tif");
  auto output = OIIO::ImageOutput::create(file);
  ASSERT_TRUE(output->open(file, spec));
  const std::uint16_t pixel[] = {257, 65278};
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT16, pixel) && output->close());
  const auto weights = region_weights(three().topology, three().uvs, {MaskSource(file)}, 2);
  EXPECT_NEAR(weights.alpha(0, 0), 257.0 / 65535, 1e-9);
}

}  // namespace
}  // namespace crowdface
