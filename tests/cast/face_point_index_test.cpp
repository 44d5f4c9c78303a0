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
