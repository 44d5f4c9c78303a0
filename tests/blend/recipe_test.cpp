// SPDX-License-Identifier: Apache-2.0
#include "crowdface/blend/recipe.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "crowdface/core/require.h"

namespace crowdface {
namespace {

using Weights = std::vector<SourceWeight>;
constexpr auto kPartition = Normalization::kPartition;
constexpr auto kPrinted = Normalization::kPrinted;

// Squared distances from the origin: 1, 4, 9, 16; Eq. 4 gives 1, 1/4, 1/9, 1/16.
const std::vector<PlanePoint> kAnchors = {{1, 0}, {0, 2}, {-3, 0}, {0, -4}};
const std::vector<Index> kAll = {0, 1, 2, 3};
const PlanePoint kOrigin(0, 0);

void expect_weights(const Weights& found, const Weights& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].head, expected[i].head);
    EXPECT_NEAR(found[i].weight, expected[i].weight, 1e-15);
  }
}

TEST(WeightsAt, PartitionSumsToOneWithTheTarget) {
  const double sum = 1 + 1. / 4 + 1. / 9 + 1. / 16;
  expect_weights(weights_at_position(kAnchors, 2, kAll, kOrigin, kPartition, std::nullopt),
                 {{0, 1 / sum}, {1, 1. / 4 / sum}, {2, 1. / 9 / sum}, {3, 1. / 16 / sum}});
}

TEST(WeightsAt, PartitionCountsTheTargetEvenIfItIsNoSource) {
  const double sum = 1 + 1. / 9;
  expect_weights(weights_at_position(kAnchors, 2, {0}, kOrigin, kPartition, std::nullopt),
                 {{0, 1 / sum}, {2, 1. / 9 / sum}});
}

TEST(WeightsAt, PrintedCountsTheTargetInTheDenominatorOnly) {
  const double sum = 1 + 1. / 4 + 1. / 9 + 1. / 16;
  const Weights expected = {{0, 1 / sum}, {1, 1. / 4 / sum}, {3, 1. / 16 / sum}};
  expect_weights(weights_at_position(kAnchors, 2, kAll, kOrigin, kPrinted, std::nullopt), expected);
  expect_weights(weights_at_position(kAnchors, 2, {0, 1, 3}, kOrigin, kPrinted, std::nullopt),
                 expected);
}

TEST(WeightsAt, OnAnAnchorItsHeadTakesAll) {
  for (const PlanePoint& m : {kAnchors[1], PlanePoint(kAnchors[1] + PlanePoint(1e-200, 0))}) {
    expect_weights(weights_at_position(kAnchors, 1, kAll, m, kPartition, std::nullopt), {{1, 1}});
    expect_weights(weights_at_position(kAnchors, 0, kAll, m, kPartition, std::nullopt), {{1, 1}});
    expect_weights(weights_at_position(kAnchors, 1, kAll, m, kPrinted, std::nullopt), {});
    expect_weights(weights_at_position(kAnchors, 0, kAll, m, kPrinted, std::nullopt), {{1, 1}});
  }
}

TEST(WeightsAt, HeadsAtOneAnchorShare) {
  const std::vector<PlanePoint> anchors = {{1, 0}, {0, 2}, {0, 2}};
  expect_weights(weights_at_position(anchors, 0, {0, 1, 2}, anchors[1], kPartition, std::nullopt),
                 {{1, 0.5}, {2, 0.5}});
  expect_weights(weights_at_position(anchors, 1, {0, 1, 2}, anchors[1], kPrinted, std::nullopt),
                 {{2, 0.5}});
}

TEST(WeightsAt, MostSourcesKeepTheLargestAndNormaliseAgain) {
  // The target's ω_0 = 1/16 always stays and is not counted.
  const double with_target = 1 + 1. / 4 + 1. / 16;
  expect_weights(weights_at_position(kAnchors, 3, kAll, kOrigin, kPartition, 2),
                 {{0, 1 / with_target}, {1, 1. / 4 / with_target}, {3, 1. / 16 / with_target}});
  expect_weights(weights_at_position(kAnchors, 1, kAll, kOrigin, kPartition, 1),
                 {{0, 0.8}, {1, 0.2}});
  expect_weights(weights_at_position(kAnchors, 1, kAll, kOrigin, kPartition, 99),
                 weights_at_position(kAnchors, 1, kAll, kOrigin, kPartition, std::nullopt));
  const double sum = 1 + 1. / 4 + 1. / 16;
  expect_weights(weights_at_position(kAnchors, 3, kAll, kOrigin, kPrinted, 2),
                 {{0, 1 / sum}, {1, 1. / 4 / sum}});
}

TEST(WeightsAt, OfEqualWeightsTheFirstIsKept) {
  const std::vector<PlanePoint> anchors = {{3, 0}, {0, 1}, {1, 0}, {0, -1}};
  const double sum = 1. / 9 + 2;
  expect_weights(weights_at_position(anchors, 0, kAll, kOrigin, kPartition, 2),
                 {{0, 1. / 9 / sum}, {1, 1 / sum}, {2, 1 / sum}});
}

TEST(WeightsAt, FarAndNearAnchorsStayFinite) {
  const std::vector<PlanePoint> anchors = {{1e6, 1e6}, {-1e6, 0}, {1e-150, 0}, {1e200, 0}};
  const Weights weights = weights_at_position(anchors, 0, kAll, kOrigin, kPartition, std::nullopt);
  double sum = 0;
  for (const SourceWeight& w : weights) {
    EXPECT_TRUE(std::isfinite(w.weight)) << w.head;
    EXPECT_GT(w.weight, 0);
    sum += w.weight;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(NormalizedWeights, SumToOneAscendingWithoutZeros) {
  expect_weights(normalized_weights({{2, 6}, {0, 2}, {1, 0}}), {{0, 0.25}, {2, 0.75}});
  expect_weights(normalized_weights({{0, 1e300}, {1, 1e300}}), {{0, 0.5}, {1, 0.5}});
}

TEST(NormalizedWeights, NegativeInfiniteAndZeroSumAreRefused) {
  for (const Weights& bad : std::vector<Weights>{{},
                                                 {{0, 0}},
                                                 {{0, 2}, {1, -1}},
                                                 {{0, std::nan("")}},
                                                 {{0, std::numeric_limits<double>::infinity()}}}) {
    EXPECT_THROW(normalized_weights(bad), BrokenPrecondition);
  }
}

}  // namespace
}  // namespace crowdface
