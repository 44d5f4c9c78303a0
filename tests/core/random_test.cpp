// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/random.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

TEST(Random, IsAPureFunctionOfItsKey) {
  const RandomKey key{7, 3, "position/top", 1};
  EXPECT_EQ(random_pair(key), random_pair(key));
  const double value = random_uniform(key);
  EXPECT_NE(value, random_uniform({8, 3, "position/top", 1}));
  EXPECT_NE(value, random_uniform({7, 4, "position/top", 1}));
  EXPECT_NE(value, random_uniform({7, 3, "position/bottom", 1}));
  EXPECT_NE(value, random_uniform({7, 3, "position/top", 2}));
  EXPECT_NE(value, random_pair(key, 1)[0]);
}

TEST(Random, KeepsItsNumbersForEver) {
  // Plans made today must come out the same next year: these were written down when the generator
  // was.
  EXPECT_EQ(random_uniform({1, 1, "target/", 0}), 0.28088550074079432);
  EXPECT_EQ(random_uniform({20261121, 300, "position/top", 2}), 0.25514968957198925);
}

TEST(Random, IsUniform) {
  constexpr int kDraws = 20000;
  double sum = 0, squares = 0, product = 0;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const auto [u, v] = random_pair({5, i, "test", 0});
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    squares += u * u;
    product += (u - 0.5) * (v - 0.5);
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 0.01);
  EXPECT_NEAR(squares / kDraws, 1.0 / 3, 0.01);
  EXPECT_NEAR(product / kDraws, 0, 0.003);
}

TEST(Random, NormalHasUnitVariance) {
  constexpr int kDraws = 20000;
  double sum = 0, squares = 0;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const double x = random_normal({5, i, "test", 0});
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / kDraws, 0, 0.03);
  EXPECT_NEAR(squares / kDraws, 1, 0.04);
}

TEST(Random, StratifiedFillsEachPartOnceARun) {
  double sum = 0;
  int first_part = 0;
  for (std::uint64_t run = 0; run < 400; ++run) {
    std::array<int, 5> parts{};
    for (std::uint64_t i = 0; i < 5; ++i) {
      const double x = random_stratified({8, 5 * run + i, "test"}, 5);
      ASSERT_GE(x, 0);
      ASSERT_LT(x, 1);
      ++parts[static_cast<std::size_t>(5 * x)];
      sum += x;
      first_part += i == 0 && x < 0.2 ? 1 : 0;
    }
    EXPECT_EQ(parts, (std::array<int, 5>{1, 1, 1, 1, 1}));
  }
  EXPECT_NEAR(sum / 2000, 0.5, 0.01);
  EXPECT_NEAR(first_part, 80, 30) << "runs begin anywhere";
  EXPECT_EQ(random_stratified({8, 3, "test"}, 5), random_stratified({8, 3, "test"}, 5));
}

}  // namespace
}  // namespace crowdface
