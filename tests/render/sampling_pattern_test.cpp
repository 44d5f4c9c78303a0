// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/sampling_pattern.h"

#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

TEST(PlacesInPixel, ShareNoFineRowOrColumn) {
  for (const int side : {1, 2, 3, 5}) {
    std::set<int> columns;
    std::set<int> rows;
    const auto cells = static_cast<float>(side * side);
    for (const auto& place : sample_positions_in_pixel(side)) {
      columns.insert(static_cast<int>(place.x() * cells));
      rows.insert(static_cast<int>(place.y() * cells));
    }
    EXPECT_EQ(columns.size(), static_cast<std::size_t>(side * side));
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(side * side));
  }
}

/// All points of the square of kInterleavePeriod² pixels whose upper left corner is (x, y).
std::vector<Eigen::Vector2f> points_around(const InterleavedDisc& disc, int rays, int x, int y) {
  std::vector<Eigen::Vector2f> points;
  for (int j = y; j < y + kInterleavePeriod; ++j) {
    for (int i = x; i < x + kInterleavePeriod; ++i) {
      for (int k = 0; k < rays; ++k) points.push_back(disc.point(i, j, k));
    }
  }
  return points;
}

TEST(InterleavedDisc, IsEvenByAreaAroundEveryPixel) {
  const InterleavedDisc disc(14);
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();
  float square = 0;
  const auto points = points_around(disc, 14, 5, 7);
  for (const auto& point : points) {
    EXPECT_LE(point.norm(), 1);
    mean += point / static_cast<float>(points.size());
    square += point.squaredNorm() / static_cast<float>(points.size());
  }
  EXPECT_LT(mean.norm(), 0.02);
  EXPECT_NEAR(square, 0.5, 0.02);  // ∫ r² over the unit disc, by its area
}

TEST(InterleavedDisc, EverySquareOfPixelsHasTheSameDirectionsAndNoneTwice) {
  const InterleavedDisc disc(3);
  const auto sorted = [&](int x, int y) {
    auto points = points_around(disc, 3, x, y);
    std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
      return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
    });
    return points;
  };
  const auto first = sorted(0, 0);
  EXPECT_EQ(std::adjacent_find(first.begin(), first.end()), first.end());
  EXPECT_EQ(first, sorted(4, 2));
  EXPECT_EQ(first, sorted(31, 17));
}

}  // namespace
}  // namespace crowdface
