// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/relief.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace crowdface::synth {
namespace {

constexpr std::uint64_t kReliefSeed = 5;

std::vector<std::uint64_t> old_heads() {
  std::vector<std::uint64_t> heads;
  for (std::uint64_t h = 0; h < 60; ++h) {
    if (random_person(kReliefSeed, h).age_years > 62) heads.push_back(h);
  }
  return heads;
}

/// How deep the deepest line of the forehead is at x between two heights, and at which height.
struct Line {
  double depth = 0, y = 0;
};
Line deepest(const Relief& relief, double x, double lowest = 3, double highest = 7) {
  Line line;
  for (double y = lowest; y < highest; y += 0.02) {
    const double depth = -relief.fold_height({x, y, 9});
    if (depth > line.depth) line = {depth, y};
  }
  return line;
}

/// On edges of 2.5 mm lines that are no wider were rows of steps, which looked like bricks.
TEST(Relief, NarrowLinesAreLeftToFineSurfaces) {
  for (const std::uint64_t head : old_heads()) {
    const Identity identity(kReliefSeed, head);
    double fine = 0, coarse = 0;
    for (double x = -3; x <= 3; x += 0.25) {
      fine = std::max(fine, deepest(Relief(identity, 0.02), x).depth);
      coarse = std::max(coarse, deepest(Relief(identity, 0.25), x).depth);
    }
    EXPECT_GT(fine, 0.01) << head;
    EXPECT_LT(coarse, 0.5 * fine) << head;
  }
}

TEST(Relief, LinesOfAForeheadAreUnevenAndEachHeadsOwn) {
  int broken = 0, elsewhere = 0;
  const std::vector<std::uint64_t> heads = old_heads();
  Line before;
  for (const std::uint64_t head : heads) {
    const Relief relief(Identity(kReliefSeed, head), 0.02);
    const Line middle = deepest(relief, 0);
    double least = middle.depth, most = middle.depth;
    for (const double step : {-0.1, 0.1}) {  // follow the line to both sides
      double y = middle.y;
      for (int i = 1; i <= 25; ++i) {
        const Line next = deepest(relief, i * step, y - 0.12, y + 0.12);
        least = std::min(least, next.depth);
        most = std::max(most, next.depth);
        if (next.depth > 0) y = next.y;
      }
    }
    broken += least < 0.6 * most ? 1 : 0;
    elsewhere += std::abs(middle.y - before.y) > 0.05 ? 1 : 0;
    before = middle;
  }
  const auto count = static_cast<int>(heads.size());
  ASSERT_GT(count, 5);
  EXPECT_GT(broken, count / 2);
  EXPECT_GT(elsewhere, count / 2);
}

}  // namespace
}  // namespace crowdface::synth
