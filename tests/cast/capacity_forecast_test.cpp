// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/capacity_forecast.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "crowdface/core/random.h"
#include "crowdface/core/require.h"

namespace crowdface {
namespace {

using Point = std::vector<double>;

/// Places random points in a cube, densest in its middle. Points are drawn in rounds; of the points
/// of a round that are far enough from all placed points, the last is placed.
struct FirstFit {
  std::vector<Point> placed;
  std::uint64_t draws = 0;
  std::size_t dimensions;
  double distance;

  bool near_another(const Point& point) const {
    return std::any_of(placed.begin(), placed.end(), [&](const Point& other) {
      double squares = 0;
      for (std::size_t d = 0; d < dimensions; ++d) {
        squares += (point[d] - other[d]) * (point[d] - other[d]);
      }
      return squares < distance * distance;
    });
  }

  Point draw() {
    Point point(dimensions);
    for (std::size_t d = 0; d < dimensions; ++d) {
      const auto [a, b] = random_pair({7, draws, "point"}, static_cast<std::uint32_t>(d));
      point[d] = 0.5 * (a + b);
    }
    ++draws;
    return point;
  }

  struct Draws {
    std::uint64_t too_near = 0, far_enough = 0;
  };
  /// Draws rounds until a point is far enough, and places it. Gives up after 1,000 points that are
  /// too near.
  Draws place(std::uint64_t round) {
    Draws counts;
    Point last;
    while (counts.far_enough == 0 && counts.too_near < 1000) {
      for (std::uint64_t i = 0; i < round; ++i) {
        Point point = draw();
        if (near_another(point)) {
          ++counts.too_near;
        } else {
          ++counts.far_enough;
          last = std::move(point);
        }
      }
    }
    if (counts.far_enough > 0) placed.push_back(std::move(last));
    return counts;
  }
};

TEST(CapacityForecast, TellsEarlyHowManyPointsWillFit) {
  struct Case {
    std::size_t dimensions;
    double distance;
  };
  for (const Case& c : {Case{2, 0.02}, Case{3, 0.07}, Case{5, 0.24}}) {
    SCOPED_TRACE(std::to_string(c.dimensions) + " dimensions");
    constexpr std::uint64_t kRound = 4;
    FirstFit fit{{}, 0, c.dimensions, c.distance};
    CapacityForecast forecast;
    double early = 0;
    std::size_t told_at = 0;
    for (;;) {
      const FirstFit::Draws draws = fit.place(kRound);
      if (draws.far_enough == 0) break;
      forecast.add(draws.too_near, draws.far_enough);
      if (early == 0 && forecast.estimated_face_count()) {
        early = *forecast.estimated_face_count();
        told_at = fit.placed.size();
      }
    }
    const auto fitted = static_cast<double>(fit.placed.size());
    EXPECT_GT(fitted, 500);
    EXPECT_GT(early, fitted / 3);
    EXPECT_LT(early, fitted * 3);
    EXPECT_LT(told_at, fit.placed.size() / 2) << "foreseen, not seen";
  }
}

// Nine in ten candidates fall into a corner that is full soon: the others have the rest of the
// room.
TEST(CapacityForecast, IsNotMisledByAPlaceWhereManyCrowdTogether) {
  constexpr double kCorner = 0.1, kDistance = 0.01;
  std::vector<Point> placed;
  std::vector<std::vector<std::size_t>> cells(100 * 100);
  CapacityForecast forecast;
  std::optional<double> least;
  std::uint64_t draws = 0;
  for (;;) {
    std::uint64_t too_near = 0;
    for (; too_near < 1000; ++too_near) {
      const auto [x, y] = random_pair({3, draws, "point"});
      const bool corner = random_uniform({3, draws++, "where"}) < 0.9;
      const Point point = {corner ? kCorner * x : x, corner ? kCorner * y : y};
      const auto cell = [](double v) { return static_cast<int>(v / kDistance); };
      bool near = false;
      for (int i = cell(point[0]) - 1; i <= cell(point[0]) + 1; ++i) {
        for (int j = cell(point[1]) - 1; j <= cell(point[1]) + 1; ++j) {
          if (i < 0 || j < 0 || i > 99 || j > 99) continue;
          for (const std::size_t p : cells[static_cast<std::size_t>(100 * i + j)]) {
            near = near || std::hypot(placed[p][0] - point[0], placed[p][1] - point[1]) < kDistance;
          }
        }
      }
      if (near) continue;
      cells[static_cast<std::size_t>(100 * cell(point[0]) + cell(point[1]))].push_back(
          placed.size());
      placed.push_back(point);
      break;
    }
    if (too_near == 1000) break;
    forecast.add(too_near, 1);
    if (placed.size() < 512) continue;
    if (const auto faces = forecast.estimated_face_count(); faces && (!least || *faces < *least))
      least = faces;
  }
  const auto fitted = static_cast<double>(placed.size());
  EXPECT_GT(fitted, 4000);
  ASSERT_TRUE(least);
  EXPECT_GT(*least, fitted / 4) << fitted;
}

TEST(CapacityForecast, KeepsSilentWhileItHasSeenTooLittle) {
  CapacityForecast forecast;
  const auto add = [&](int face) { forecast.add(face < 128 ? 5 : 10, 5); };
  for (int i = 0; i < 255; ++i) add(i);
  EXPECT_FALSE(forecast.estimated_face_count()) << "few faces";
  add(255);
  ASSERT_TRUE(forecast.estimated_face_count());
  EXPECT_NEAR(*forecast.estimated_face_count(), 256 + 4 * (1.0 / 3) / ((2.0 / 3 - 0.5) / 96), 1e-9);
  CapacityForecast level;
  for (int i = 0; i < 1000; ++i) level.add(10, 1);
  EXPECT_FALSE(level.estimated_face_count()) << "it does not get harder";
  CapacityForecast roomy;
  for (int i = 0; i < 100'000; ++i) roomy.add(i % 2000 == 0 ? 1 : 0, 8);
  EXPECT_FALSE(roomy.estimated_face_count()) << "nothing is too near";
  EXPECT_THROW(roomy.add(1, 0), BrokenPrecondition);
}

}  // namespace
}  // namespace crowdface
