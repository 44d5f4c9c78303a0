// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/heat_colours.h"

#include <gtest/gtest.h>

namespace crowdface {
namespace {

TEST(HeatColour, GoesFromBlueToRed) {
  const Eigen::Vector3f low = heat_colour(0);
  const Eigen::Vector3f high = heat_colour(1);
  EXPECT_GT(low.z(), low.x() + 0.2F);
  EXPECT_GT(high.x(), high.z() + 0.2F);
}

TEST(HeatColour, IsContinuousAndClamped) {
  EXPECT_EQ(heat_colour(-3), heat_colour(0));
  EXPECT_EQ(heat_colour(7), heat_colour(1));
  for (int i = 0; i < 1000; ++i) {
    EXPECT_LT((heat_colour((i + 1) / 1000.0) - heat_colour(i / 1000.0)).norm(), 0.01F);
  }
}

TEST(HeatColours, MeasureAgainstTheScale) {
  const VertexColours colours = heat_colours(Eigen::Vector3d(0, 2, 9), 4);
  EXPECT_EQ(colours.row(0).transpose(), heat_colour(0));
  EXPECT_EQ(colours.row(1).transpose(), heat_colour(0.5));
  EXPECT_EQ(colours.row(2).transpose(), heat_colour(1));
}

TEST(ScaleTicks, AreRoundFewAndWithinTheScale) {
  for (const double most : {0.003, 0.05, 0.7, 1.0, 4.0, 6.0, 9.9, 250.0}) {
    const std::vector<double> ticks = scale_ticks(most);
    EXPECT_GE(ticks.size(), 3U) << most;
    EXPECT_LE(ticks.size(), 6U) << most;
    EXPECT_EQ(ticks.front(), 0);
    EXPECT_LE(ticks.back(), most * (1 + 1e-9));
    EXPECT_GT(ticks.back() + ticks[1], most) << most;
  }
  EXPECT_EQ(scale_ticks(1), (std::vector<double>{0, 0.2, 0.4, 0.6, 0.8, 1}));
  EXPECT_EQ(scale_ticks(6), (std::vector<double>{0, 2, 4, 6}));
}

TEST(HeatScale, ShowsEveryColourOfTheScaleOnce) {
  const Rgb8Image scale = heat_scale(6, "distance", 600, 40, {0, 0, 0});
  EXPECT_EQ(scale.width, 600);
  const int y = 40 / 8 + 2;
  int first = 0;
  while (scale.at(first, y)[2] == 0) ++first;
  EXPECT_GT(first, 150);
  int last = 599;
  while (scale.at(last, y)[0] == 0) --last;
  EXPECT_GT(scale.at(first, y)[2], scale.at(first, y)[0]);
  EXPECT_GT(scale.at(last, y)[0], scale.at(last, y)[2]);
}

}  // namespace
}  // namespace crowdface
