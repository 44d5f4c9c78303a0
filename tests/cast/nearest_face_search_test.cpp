// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/nearest_face_search.h"

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
      point.coordinates_with_extrapolation[d] = static_cast<float>(scale * (a - 0.5));
      point.coordinates_without_extrapolation[d] = extrapolated && i % 2 == 0
                                                       ? static_cast<float>(scale * (b - 0.5))
                                                       : point.coordinates_with_extrapolation[d];
    }
    points.push_back(point);
  }
  return points;
}

TEST(NearestFaceSearch, FindsTheNearestAsASearchThroughAllDoes) {
  for (const Index dimensions : {1, 16, 37, 100}) {
    for (const bool extrapolated : {false, true}) {
      const auto points = random_points(203, dimensions, extrapolated);
      NearestFaceSearch index(dimensions);
      for (const FaceSpace::Point& point : points) index.add(point);
      ASSERT_EQ(index.size(), 203);
      const auto queries = random_points(260, dimensions, true);
      for (std::size_t q = 203; q < queries.size(); ++q) {
        for (const auto& [begin, end] : {std::pair<Index, Index>{0, 203}, {5, 150}, {33, 34}}) {
          NearestFaceSearch::NearestFace expected;
          for (Index i = begin; i < end; ++i) {
            const double mm = FaceSpace::distance(queries[q], points[static_cast<std::size_t>(i)]);
            if (mm < expected.distance_mm) expected = {i, mm};
          }
          const auto found = index.nearest(queries[q], HUGE_VAL, begin, end);
          EXPECT_EQ(found.face, expected.face);
          EXPECT_NEAR(found.distance_mm, expected.distance_mm, 1e-5);
          EXPECT_EQ(index.nearest(queries[q], expected.distance_mm * 0.999, begin, end).face, -1);
          EXPECT_EQ(index.nearest(queries[q], expected.distance_mm * 1.001, begin, end).face,
                    found.face);
        }
      }
    }
  }
}

/// So many that there are trees of several sizes beside the newest.
TEST(NearestFaceSearch, FindsTheNearestOfMany) {
  constexpr Index kDimensions = 20;
  auto points = random_points(15000, kDimensions, true);
  for (std::size_t i = 0; i < 4000; ++i) points[8000 + i] = points[3 * i];  // equally near ones
  NearestFaceSearch index(kDimensions);
  const auto queries = random_points(15060, kDimensions, true);
  for (std::size_t i = 0; i < points.size(); ++i) index.add(points[i]);
  for (std::size_t q = 15000; q < queries.size(); ++q) {
    const FaceSpace::Point& query = q % 3 == 0 ? points[q - 15000] : queries[q];
    for (const auto& [begin, end] :
         {std::pair<Index, Index>{0, 15000}, {100, 9000}, {14990, 15000}, {7, 8}}) {
      NearestFaceSearch::NearestFace expected;
      NearestFaceSearch few(kDimensions);  // so few that all are met
      Index first = begin;
      for (Index i = begin; i < end; ++i) {
        few.add(points[static_cast<std::size_t>(i)]);
        if (few.size() < 1000 && i + 1 < end) continue;
        const auto found = few.nearest(query);
        if (found.distance_mm < expected.distance_mm)
          expected = {first + found.face, found.distance_mm};
        few = NearestFaceSearch(kDimensions);
        first = i + 1;
      }
      const auto found = index.nearest(query, HUGE_VAL, begin, end);
      EXPECT_EQ(found.face, expected.face) << begin << ' ' << end;
      EXPECT_EQ(found.distance_mm, expected.distance_mm);
      EXPECT_EQ(index.nearest(query, HUGE_VAL, begin, end, 0.999 * expected.distance_mm).face,
                expected.face)
          << "none is nearer";
      const auto any = index.nearest(query, HUGE_VAL, begin, end, 2 * expected.distance_mm);
      EXPECT_GE(any.distance_mm, expected.distance_mm);
      EXPECT_LE(any.distance_mm, 2 * expected.distance_mm) << "near enough";
      EXPECT_TRUE(any.face >= begin && any.face < end);
      EXPECT_EQ(index.nearest(query, expected.distance_mm * 0.999, begin, end).face, -1);
    }
  }
}

TEST(NearestFaceSearch, BitsDoNotDependOnWhatElseIsStored) {
  const auto points = random_points(50, 40, true);
  NearestFaceSearch all(40), two(40);
  for (const FaceSpace::Point& point : points) all.add(point);
  two.add(points[49]);
  const FaceSpace::Point& query = points[3];
  EXPECT_EQ(all.nearest(query, HUGE_VAL, 49, 50).distance_mm, two.nearest(query).distance_mm);
}

TEST(NearestFaceSearch, EmptyOneHasNoNearest) {
  const auto points = random_points(1, 8, false);
  const auto nearest = NearestFaceSearch(8).nearest(points[0]);
  EXPECT_EQ(nearest.face, -1);
  EXPECT_EQ(nearest.distance_mm, HUGE_VAL);
}

}  // namespace
}  // namespace crowdface
