// SPDX-License-Identifier: Apache-2.0
#include "crowdface/plane/layout.h"

#include <cmath>

#include <gtest/gtest.h>

#include "crowdface/core/random.h"

namespace crowdface {
namespace {

TEST(CircleLayout, IsEvenAndRounded) {
  const auto anchors = circle_layout(5);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(anchors[i].norm(), 1, 2e-9);
    EXPECT_NEAR((anchors[i] - anchors[(i + 1) % 5]).norm(), 2 * std::sin(3.14159265358979 / 5),
                2e-9);
    EXPECT_EQ(anchors[i].x(), std::round(anchors[i].x() * 1e9) / 1e9);
  }
  EXPECT_EQ(anchors[0], PlanePoint(1, 0));
  EXPECT_EQ(circle_layout(4)[1], PlanePoint(0, 1));
}

TEST(GridLayout, FillsASquareRowByRow) {
  const auto anchors = grid_layout(7);  // 3 + 3 + 1
  EXPECT_EQ(anchors[0], PlanePoint(-1, 1));
  EXPECT_EQ(anchors[2], PlanePoint(1, 1));
  EXPECT_EQ(anchors[4], PlanePoint(0, 0));
  EXPECT_EQ(anchors[6], PlanePoint(0, -1));
  EXPECT_EQ(grid_layout(1)[0], PlanePoint(0, 0));
}

TEST(SimilarityLayout, RecoversPointsOfThePlaneUpToMotionAndScale) {
  const std::vector<PlanePoint> points = {{0, 0}, {4, 0}, {4, 1}, {-2, 0.5}, {1, -3}};
  Eigen::MatrixXd distances(5, 5);
  for (Eigen::Index a = 0; a < 5; ++a) {
    for (Eigen::Index b = 0; b < 5; ++b) {
      distances(a, b) =
          (points[static_cast<std::size_t>(a)] - points[static_cast<std::size_t>(b)]).norm();
    }
  }
  const auto anchors = similarity_layout(distances);
  const double scale = (anchors[0] - anchors[1]).norm() / distances(0, 1);
  double radius = 0;
  for (std::size_t a = 0; a < 5; ++a) {
    radius = std::max(radius, anchors[a].norm());
    for (std::size_t b = 0; b < 5; ++b) {
      EXPECT_NEAR((anchors[a] - anchors[b]).norm(),
                  scale * distances(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)),
                  1e-8);
    }
  }
  EXPECT_NEAR(radius, 1, 1e-8);
}

TEST(ConvexHull, DropsInnerAndCollinearPoints) {
  const auto hull = convex_hull({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}, {0, 0}});
  EXPECT_EQ(hull, (std::vector<PlanePoint>{{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
  EXPECT_EQ(convex_hull({{1, 1}, {1, 1}}).size(), 1U);
  EXPECT_EQ(convex_hull({{0, 0}, {1, 1}, {2, 2}}).size(), 2U);
}

TEST(PointInPolygon, IsUniformByArea) {
  // Counts in the two halves of an L-free trapezium go like their areas.
  const std::vector<PlanePoint> trapezium = {{0, 0}, {3, 0}, {2, 1}, {0, 1}};
  int left = 0, total = 0;
  double mean_y = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const auto [pick, a] = random_pair({1, i, "test", 0});
    const PlanePoint p = sample_polygon(trapezium, pick, a, random_uniform({1, i, "b", 0}));
    ASSERT_GE(p.y(), 0);
    ASSERT_LE(p.y(), 1);
    ASSERT_GE(p.x(), 0);
    ASSERT_LE(p.x() + p.y(), 3 + 1e-12);
    left += p.x() < 1 ? 1 : 0;
    mean_y += p.y();
    ++total;
  }
  EXPECT_NEAR(static_cast<double>(left) / total, 1 / 2.5, 0.015);
  EXPECT_NEAR(mean_y / total, (1.0 / 2 * 2 + 1.0 / 3 * 0.5) / 2.5, 0.01);
}

TEST(PointInPolygon, TakesPointsAndSegments) {
  EXPECT_EQ(sample_polygon({{3, 4}}, 0.3, 0.4, 0.5), PlanePoint(3, 4));
  EXPECT_EQ(sample_polygon({{0, 0}, {2, 4}}, 0.9, 0.25, 0.5), PlanePoint(0.5, 1));
}

}  // namespace
}  // namespace crowdface
