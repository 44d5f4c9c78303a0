// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_point_index.h"

#include <gtest/gtest.h>

#include "crowdface/core/random.h"

namespace crowdface {
namespace {

/// Places whose leading coordinates vary most, some of them extrapolated.
std::vector<FaceSpace::Point> random_points(std::uint64_t count, Index dimensions,
                                            bool extrapolated) {
  std::vector<FaceSpace::Point> points;
  for (std::uint64_t i = 0; i < count; ++i) {
    FaceSpace::Point point{Eigen::VectorXf(dimensions), Eigen::VectorXf(dimensions)};
    for (Index d = 0; d < dimensions; ++d) {
      const auto [a, b] = random_pair({7, i, "place", 0}, static_cast<std::uint32_t>(d));
      const double scale = 5 / (1 + static_cast<double>(d));
      point.as_built[d] = static_cast<float>(scale * (a - 0.5));
      point.unit[d] =
          extrapolated && i % 2 == 0 ? static_cast<float>(scale * (b - 0.5)) : point.as_built[d];
    }
    points.push_back(point);
  }
  return points;
}

TEST(FacePointIndex, FindsTheNearestAsASearchThroughAllDoes) {
  for (const Index dimensions : {1, 16, 37, 100}) {
    for (const bool extrapolated : {false, true}) {
      const auto points = random_points(203, dimensions, extrapolated);
      FacePointIndex index(dimensions);
      for (const FaceSpace::Point& point : points) index.add(point);
      ASSERT_EQ(index.size(), 203);
      const auto queries = random_points(260, dimensions, true);
      for (std::size_t q = 203; q < queries.size(); ++q) {
        for (const auto& [begin, end] : {std::pair<Index, Index>{0, 203}, {5, 150}, {33, 34}}) {
          FacePointIndex::Nearest expected;
          for (Index i = begin; i < end; ++i) {
            const double mm = FaceSpace::distance(queries[q], points[static_cast<std::size_t>(i)]);
            if (mm < expected.mm) expected = {i, mm};
          }
          const auto found = index.nearest(queries[q], HUGE_VAL, begin, end);
          EXPECT_EQ(found.face, expected.face);
          EXPECT_NEAR(found.mm, expected.mm, 1e-5);
          EXPECT_EQ(index.nearest(queries[q], expected.mm * 0.999, begin, end).face, -1);
          EXPECT_EQ(index.nearest(queries[q], expected.mm * 1.001, begin, end).face, found.face);
        }
      }
    }
  }
}

/// So many that there are trees of several sizes beside the newest.
TEST(FacePointIndex, FindsTheNearestOfMany) {
  constexpr Index kDimensions = 20;
  auto points = random_points(15000, kDimensions, true);
  for (std::size_t i = 0; i < 4000; ++i) points[8000 + i] = points[3 * i];  // equally near ones
  FacePointIndex index(kDimensions);
  const auto queries = random_points(15060, kDimensions, true);
  for (std::size_t i = 0; i < points.size(); ++i) index.add(points[i]);
  for (std::size_t q = 15000; q < queries.size(); ++q) {
    const FaceSpace::Point& query = q % 3 == 0 ? points[q - 15000] : queries[q];
    for (const auto& [begin, end] :
         {std::pair<Index, Index>{0, 15000}, {100, 9000}, {14990, 15000}, {7, 8}}) {
      FacePointIndex::Nearest expected;
      FacePointIndex few(kDimensions);  // so few that all are met
      Index first = begin;
      for (Index i = begin; i < end; ++i) {
        few.add(points[static_cast<std::size_t>(i)]);
        if (few.size() < 1000 && i + 1 < end) continue;
        const auto found = few.nearest(query);
        if (found.mm < expected.mm) expected = {first + found.face, found.mm};
        few = FacePointIndex(kDimensions);
        first = i + 1;
      }
      const auto found = index.nearest(query, HUGE_VAL, begin, end);
      EXPECT_EQ(found.face, expected.face) << begin << ' ' << end;
      EXPECT_EQ(found.mm, expected.mm);
      EXPECT_EQ(index.nearest(query, HUGE_VAL, begin, end, 0.999 * expected.mm).face, expected.face)
          << "none is nearer";
      const auto any = index.nearest(query, HUGE_VAL, begin, end, 2 * expected.mm);
      EXPECT_GE(any.mm, expected.mm);
      EXPECT_LE(any.mm, 2 * expected.mm) << "near enough";
      EXPECT_TRUE(any.face >= begin && any.face < end);
      EXPECT_EQ(index.nearest(query, expected.mm * 0.999, begin, end).face, -1);
    }
  }
}

TEST(FacePointIndex, BitsDoNotDependOnWhatElseIsStored) {
  const auto points = random_points(50, 40, true);
  FacePointIndex all(40), two(40);
  for (const FaceSpace::Point& point : points) all.add(point);
  two.add(points[49]);
  const FaceSpace::Point& query = points[3];
  EXPECT_EQ(all.nearest(query, HUGE_VAL, 49, 50).mm, two.nearest(query).mm);
}

TEST(FacePointIndex, EmptyOneHasNoNearest) {
  const auto points = random_points(1, 8, false);
  const auto nearest = FacePointIndex(8).nearest(points[0]);
  EXPECT_EQ(nearest.face, -1);
  EXPECT_EQ(nearest.mm, HUGE_VAL);
}

}  // namespace
}  // namespace crowdface
