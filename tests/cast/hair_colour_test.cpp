// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/hair_colour.h"

#include <gtest/gtest.h>

namespace crowdface {
namespace {

TEST(HairColour, HasALabelThatReadsBack) {
  for (const NamedHairColour& named : named_hair_colours()) {
    EXPECT_EQ(parse_hair_label(colour_label(named.colour)), named.colour) << named.name;
  }
  EXPECT_EQ(colour_label({0.55, 0.1, 0}), "e55p10g0");
  for (const char* wrong : {"", "e55", "e55p10g", "e55p10g0x", "p10e55g0", "e555p10g0"}) {
    EXPECT_FALSE(parse_hair_label(wrong)) << wrong;
  }
}

TEST(HairColour, LightLiesOnTheNaturalScale) {
  const auto light = [](const char* name) { return reflected_light(*hair_colour_named(name)); };
  const char* darker[] = {"white", "blond", "light_brown", "brown", "dark_brown", "black"};
  for (std::size_t i = 2; i < std::size(darker); ++i) {
    EXPECT_LT(light(darker[i])[1], 0.7F * light(darker[i - 1])[1]) << darker[i];
  }
  EXPECT_GT(light("red")[0] / light("red")[1], 2 * light("brown")[0] / light("brown")[1]);
  EXPECT_NEAR(light("white")[0], light("white")[2], 0.06);
  for (const NamedHairColour& named : named_hair_colours()) {
    for (const float factor : tint_factors(named.colour)) {
      EXPECT_GT(factor, 0);
      EXPECT_LE(factor, 1);
    }
  }
}

TEST(HairColour, OfTheBodyDiffersAsPeoplesDoes) {
  const HairColour hair{0.5, 0.1, 0.5};
  EXPECT_EQ(hair_colour_for(hair, Tint::kHair), hair);
  const HairColour brows = hair_colour_for(hair, Tint::kBrows),
                   beard = hair_colour_for(hair, Tint::kBeard);
  EXPECT_GT(brows.eumelanin, hair.eumelanin);
  EXPECT_LT(brows.grey_fraction, hair.grey_fraction);
  // White brows on a grey man and blond ones on tanned skin looked glued on.
  EXPECT_LT(hair_colour_for({0.5, 0, 1}, Tint::kBrows).grey_fraction, 0.7);
  EXPECT_GT(hair_colour_for({0.2, 0, 0}, Tint::kBrows).eumelanin, 0.35);
  EXPECT_GT(beard.pheomelanin, hair.pheomelanin);
  EXPECT_GT(hair_colour_for(hair, Tint::kLashes).eumelanin, brows.eumelanin);
  EXPECT_LT(hair_colour_for({0.5, 0, 1}, Tint::kLashes).grey_fraction, 0.3);
}

}  // namespace
}  // namespace crowdface
