// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/sampling_pattern.h"

#include <set>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

TEST(SamplingPattern, PlacesShareNoFineRowOrColumn) {
  for (const int side : {1, 2, 3, 5}) {
    const SamplingPattern pattern(side, 0);
    std::set<int> columns;
    std::set<int> rows;
    const auto cells = static_cast<float>(side * side);
    for (const auto& place : pattern.places) {
      columns.insert(static_cast<int>(place.x() * cells));
      rows.insert(static_cast<int>(place.y() * cells));
    }
    EXPECT_EQ(columns.size(), static_cast<std::size_t>(side * side));
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(side * side));
    EXPECT_TRUE(pattern.sky.empty());
  }
}

TEST(SamplingPattern, DiscsAreEvenByArea) {
  const SamplingPattern pattern(4, 8);
  ASSERT_EQ(pattern.sky.size(), 128U);
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();
  float square = 0;
  for (const auto& point : pattern.sky) {
    EXPECT_LE(point.norm(), 1);
    mean += point / 128;
    square += point.squaredNorm() / 128;
  }
  EXPECT_LT(mean.norm(), 0.02);
  EXPECT_NEAR(square, 0.5, 0.02);  // ∫ r² over the unit disc, by its area
}

TEST(PixelTurn, IsAUnitVectorThatDiffersBetweenNeighbours) {
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) {
      EXPECT_NEAR(pixel_turn(x, y).norm(), 1, 1e-6);
      EXPECT_GT((pixel_turn(x, y) - pixel_turn(x + 1, y)).norm(), 0.2);
    }
  }
}

}  // namespace
}  // namespace crowdface
