// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/capacity_forecast.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "crowdface/core/random.h"
#include "crowdface/core/require.h"

namespace crowdface {
namespace {

using Point = std::vector<double>;

/// Points dropped into a cube, dense in its middle, each from as many draws as are wanted that keep the
/// distance; ends where a point fails a thousand times.
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

  /// How many draws were too near; nothing left to place if a thousand were.
  std::uint64_t place(std::uint64_t wanted) {
    std::uint64_t too_near = 0;
    Point last;
    for (std::uint64_t found = 0; found < wanted && too_near < 1000;) {
      Point point = draw();
      if (near_another(point)) {
        ++too_near;
      } else {
        ++found;
        last = std::move(point);
      }
    }
    if (too_near < 1000) placed.push_back(std::move(last));
    return too_near;
  }
};

TEST(CapacityForecast, TellsEarlyHowManyPointsWillFit) {
  struct Case {
    std::size_t dimensions;
    double distance;
  };
  for (const Case& c : {Case{2, 0.02}, Case{3, 0.07}, Case{5, 0.24}}) {
    SCOPED_TRACE(std::to_string(c.dimensions) + " dimensions");
    constexpr std::uint64_t kWanted = 4;
    FirstFit fit{{}, 0, c.dimensions, c.distance};
    CapacityForecast forecast;
    double early = 0;
    std::size_t told_at = 0;
    for (;;) {
      const std::uint64_t too_near = fit.place(kWanted);
      if (too_near >= 1000) break;
      forecast.add(too_near, kWanted);
      if (early == 0 && forecast.faces()) {
        early = *forecast.faces();
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

TEST(CapacityForecast, KeepsSilentWhileItHasSeenTooLittle) {
  CapacityForecast forecast;
  for (int i = 0; i < 255; ++i) forecast.add(10, 1);
  EXPECT_FALSE(forecast.faces()) << "few faces";
  forecast.add(10, 1);
  EXPECT_TRUE(forecast.faces());
  CapacityForecast roomy;
  for (int i = 0; i < 100'000; ++i) roomy.add(i % 2000 == 0 ? 1 : 0, 8);
  EXPECT_FALSE(roomy.faces()) << "nothing is too near";
  EXPECT_THROW(roomy.add(1, 0), BrokenPrecondition);
}

}  // namespace
}  // namespace crowdface
