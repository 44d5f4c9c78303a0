// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/likeness.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "crowdface/core/random.h"

namespace crowdface {
namespace {

FaceSpace::Point place_at(float x, float y) {
  return {Eigen::Vector2f(x, y), Eigen::Vector2f(x, y)};
}

std::vector<FaceSpace::Point> random_places(std::uint64_t count) {
  std::vector<FaceSpace::Point> points;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto [x, y] = random_pair({3, i, "place", 0});
    points.push_back(place_at(static_cast<float>(x), static_cast<float>(y)));
  }
  return points;
}

TEST(Likeness, OfNobodyIsEmpty) {
  EXPECT_TRUE(find_likeness({}, 4).face_order.empty());
}

TEST(Likeness, OfOneFaceIsThatFace) {
  const Likeness likeness = find_likeness({place_at(1, 2)}, 4);
  EXPECT_EQ(likeness.face_order, std::vector<std::size_t>{0});
  EXPECT_TRUE(likeness.neighbours[0].empty());
}

TEST(Likeness, NeighboursAreThoseOfASearchThroughAll) {
  const auto points = random_places(150);
  const Likeness likeness = find_likeness(points, 5);
  for (std::size_t face = 0; face < points.size(); ++face) {
    std::vector<double> mm;
    for (std::size_t other = 0; other < points.size(); ++other) {
      if (other != face) mm.push_back(FaceSpace::distance(points[face], points[other]));
    }
    std::sort(mm.begin(), mm.end());
    ASSERT_EQ(likeness.neighbours[face].size(), 5U);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(likeness.neighbours[face][k].distance_mm, mm[k]);
  }
}

/// In more dimensions than boxes have, some twice, and with factors that make other faces of them.
std::vector<FaceSpace::Point> points_of_many_dimensions(std::uint64_t count) {
  std::vector<FaceSpace::Point> points;
  for (std::uint64_t i = 0; i < count; ++i) {
    FaceSpace::Point point{Eigen::VectorXf(12), Eigen::VectorXf(12)};
    for (std::uint64_t d = 0; d < 12; ++d) {
      const auto [x, y] = random_pair({5, i / 2, "place", 0}, static_cast<std::uint32_t>(d));
      point.coordinates_with_extrapolation[static_cast<Index>(d)] = static_cast<float>(x);
      point.coordinates_without_extrapolation[static_cast<Index>(d)] =
          static_cast<float>(i % 3 == 0 ? x : y);
    }
    points.push_back(point);
  }
  return points;
}

// The order was once found by distances from each face to all.
TEST(Likeness, OrderIsThatOfASearchThroughAll) {
  const auto points = points_of_many_dimensions(400);
  const Likeness likeness = find_likeness(points, 6);
  std::vector<bool> met(points.size(), false);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const std::size_t at = likeness.face_order[i];
    met[at] = true;
    std::size_t next = points.size();
    for (std::size_t other = 0; other < points.size(); ++other) {
      if (met[other]) continue;
      if (next == points.size() || FaceSpace::distance(points[at], points[other]) <
                                       FaceSpace::distance(points[at], points[next])) {
        next = other;
      }
    }
    ASSERT_EQ(likeness.face_order[i + 1], next) << "after " << i;
  }
  for (std::size_t face = 0; face < points.size(); ++face) {
    std::vector<std::pair<double, std::size_t>> all;
    for (std::size_t other = 0; other < points.size(); ++other) {
      if (other != face) all.emplace_back(FaceSpace::distance(points[face], points[other]), other);
    }
    std::sort(all.begin(), all.end());
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_EQ(likeness.neighbours[face][k].face, all[k].second) << face << ", number " << k;
    }
  }
}

TEST(Likeness, OrderNamesEveryFaceOnce) {
  Likeness likeness = find_likeness(random_places(211), 1);
  std::sort(likeness.face_order.begin(), likeness.face_order.end());
  for (std::size_t i = 0; i < likeness.face_order.size(); ++i) EXPECT_EQ(likeness.face_order[i], i);
  EXPECT_EQ(likeness.face_order.size(), 211U);
}

TEST(Likeness, FacesThatAreEachOthersNearestStandSideBySide) {
  const Likeness likeness = find_likeness(random_places(300), 1);
  std::vector<std::size_t> point(300);
  for (std::size_t i = 0; i < 300; ++i) point[likeness.face_order[i]] = i;
  int pairs = 0;
  for (std::size_t face = 0; face < 300; ++face) {
    const std::size_t other = likeness.neighbours[face][0].face;
    if (likeness.neighbours[other][0].face != face) continue;
    ++pairs;
    EXPECT_EQ(std::max(point[face], point[other]) - std::min(point[face], point[other]), 1U);
  }
  EXPECT_GT(pairs, 100);
}

}  // namespace
}  // namespace crowdface
