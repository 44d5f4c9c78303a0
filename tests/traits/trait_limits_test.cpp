// SPDX-License-Identifier: Apache-2.0
#include "crowdface/traits/trait_limits.h"

#include <gtest/gtest.h>

namespace crowdface::testing {
namespace {

std::vector<std::vector<std::optional<double>>> heads(const std::vector<double>& first) {
  std::vector<std::vector<std::optional<double>>> values;
  for (const double value : first) {
    values.emplace_back(measurements().size());
    values.back()[0] = value;
  }
  return values;
}

TEST(TraitDistributions, QuantilesAreInterpolatedBetweenTheHeads) {
  const TraitDistributions spread(heads({30, 10, 20}));
  EXPECT_TRUE(spread.is_available(0));
  EXPECT_FALSE(spread.is_available(1));
  EXPECT_DOUBLE_EQ(spread.quantile(0, 0), 10);
  EXPECT_DOUBLE_EQ(spread.quantile(0, 0.25), 15);
  EXPECT_DOUBLE_EQ(spread.quantile(0, 1), 30);
  EXPECT_DOUBLE_EQ(spread.mean(0), 20);
  EXPECT_DOUBLE_EQ(spread.deviation(0), 10);
}

TEST(TraitDistributions, QuantilesOfATableReplaceThoseOfTheHeads) {
  auto values = heads({30, 10, 20});
  for (auto& head : values) head[1] = 5;
  const TraitDistributions spread(values, {{0, 100, 10}});
  EXPECT_NEAR(spread.quantile(0, 0.5), 100, 1e-5);
  EXPECT_NEAR(spread.quantile(0, 0.9), 112.81552, 1e-4);
  EXPECT_NEAR(spread.quantile(0, 0.05), 83.55146, 1e-4);
  EXPECT_DOUBLE_EQ(spread.quantile(0, 0), 40);
  EXPECT_NEAR(spread.quantile(0, 1), 160, 0.2) << "beyond 10⁻⁹, shares cannot be told apart";
  EXPECT_DOUBLE_EQ(spread.quantile(1, 0.9), 5) << "a trait that the table lacks";
  EXPECT_TRUE(spread.meets({0, TraitBound{0.9, true}}, 113));
  EXPECT_FALSE(spread.meets({0, TraitBound{0.9, true}}, 112));
  EXPECT_DOUBLE_EQ(spread.sorted_values(0).front(), 10) << "the heads' own values stay";
}

TEST(TraitDistributions, LimitsIncludeTheirEnds) {
  const TraitDistributions spread(heads({10, 20, 30}));
  const TraitLimit limit{0, TraitBound{0.5, true}, TraitBound{28, false}};
  EXPECT_FALSE(spread.meets(limit, 19.9));
  EXPECT_TRUE(spread.meets(limit, 20));
  EXPECT_TRUE(spread.meets(limit, 28));
  EXPECT_FALSE(spread.meets(limit, 28.1));
  EXPECT_TRUE(spread.meets({0}, 1000)) << "without ends nothing is refused";
}

TEST(TraitLimits, OwnLimitsReplaceThoseOfTheSameTrait) {
  const TraitLimits common = {{0, TraitBound{1}}, {2, TraitBound{3}}},
                    own = {{1}, {2, TraitBound{9}}};
  const TraitLimits expected = {{0, TraitBound{1}}, {1}, {2, TraitBound{9}}};
  EXPECT_EQ(merge_limits(common, own), expected);
}

TEST(TraitTarget, DifferencesAreThoseOfKolmogorovAndSmirnov) {
  const TraitTarget target{0, 10, 2};
  EXPECT_NEAR(normal_cdf(target, 10), 0.5, 1e-9);
  EXPECT_NEAR(normal_cdf(target, 12), 0.841344746, 1e-9);
  EXPECT_NEAR(kolmogorov_smirnov_distance(target, {10}), 0.5, 1e-9);
  EXPECT_NEAR(kolmogorov_smirnov_distance(target, {100, 101}), 1, 1e-9)
      << "far above the asked values";
}

}  // namespace
}  // namespace crowdface::testing
