// SPDX-License-Identifier: Apache-2.0
#include "crowdface/region/mask_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/error.h"

namespace crowdface {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(MaskSource, TileNumberReplacesEveryMark) {
  const MaskSource set("a.<UDIM>/b.<UDIM>.png");
  EXPECT_TRUE(set.is_tiled());
  EXPECT_EQ(set.tile_path(1012), "a.1012/b.1012.png");
  const MaskSource one("bands.png");
  EXPECT_FALSE(one.is_tiled());
  EXPECT_EQ(one.tile_path(1012), "bands.png");
}

TEST(MaskSource, AlphaIsNoMask) {
  EXPECT_THAT(mask_channel_indices({1, 1, 4, 3, {}, {}}), ElementsAre(0, 1, 2));
  EXPECT_THAT(mask_channel_indices({1, 1, 2, 1, {}, {}}), ElementsAre(0));
  EXPECT_THAT(mask_channel_indices({1, 1, 3, -1, {}, {}}), ElementsAre(0, 1, 2));
}

TEST(MaskSource, NegativeValueIsNamedUnlessAlpha) {
  Image image{2, 1, 2, -1, std::vector<float>{0, 0, 0, -0.5F}, {}};
  try {
    MaskSource("m.exr", image).read(1001);
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("m.exr"));
    EXPECT_THAT(error.what(), HasSubstr("-0.5 at column 2, row 1, channel 2"));
  }
  image.alpha_channel = 1;
  EXPECT_EQ(MaskSource("m.exr", image).read(1001).pixels, image.pixels);
}

// Resizing or sharpening an image can produce small negative values.
TEST(MaskSource, SmallNegativeValuesCountAsZero) {
  const Image image{2, 1, 2, -1, std::vector<float>{-0.0004F, 1, -0.18F, 0.5F}, {}};
  EXPECT_EQ(std::get<0>(MaskSource("m.exr", image).read(1001).pixels),
            (std::vector<float>{0, 1, 0, 0.5F}));
  const Image lower{1, 1, 1, -1, std::vector<float>{-0.25F}, {}};
  EXPECT_THROW(MaskSource("m.exr", lower).read(1001), InvalidInput);
}

TEST(MaskSource, NothingIsReadUntilAsked) {
  const std::vector<MaskSource> masks = {MaskSource("no/such/file.png"),
                                         MaskSource("none.<UDIM>.png")};
  ASSERT_EQ(masks.size(), 2U);
  EXPECT_THROW(masks[0].read(1001), MissingInput);
}

}  // namespace
}  // namespace crowdface
