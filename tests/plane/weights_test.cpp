// SPDX-License-Identifier: Apache-2.0
#include "crowdface/plane/weights.h"

#include <numeric>

#include <gtest/gtest.h>

#include "crowdface/core/require.h"

namespace crowdface {
namespace {

TEST(InverseSquareWeights, MatchTheFormula) {
  const std::vector<PlanePoint> anchors = {{0, 0}, {1, 0}, {0, 3}};
  const PlanePoint m(0.25, 0.5);
  double sum = 0;
  std::vector<double> plain;
  for (const PlanePoint& t : anchors) {
    plain.push_back(1 / (m - t).squaredNorm());  // Eq. 4
    sum += plain.back();
  }
  const std::vector<double> weights = inverse_square_weights(anchors, m);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(weights[i], plain[i] / sum, 1e-15);
}

TEST(InverseSquareWeights, AtAnAnchorItsHeadTakesAll) {
  EXPECT_EQ(inverse_square_weights({{0, 0}, {1, 0}, {0, 3}}, {1, 0}),
            (std::vector<double>{0, 1, 0}));
}

TEST(InverseSquareWeights, CoincidentAnchorsShare) {
  EXPECT_EQ(inverse_square_weights({{1, 0}, {1, 0}, {0, 3}}, {1, 0}),
            (std::vector<double>{0.5, 0.5, 0}));
}

TEST(InverseSquareWeights, SurviveTinyAndHugeDistances) {
  for (const double x : {1e-200, 1e-160, 1e150}) {
    const auto weights = inverse_square_weights({{0, 0}, {1, 0}}, {x, 0});
    EXPECT_NEAR(weights[0] + weights[1], 1, 1e-15) << x;
    EXPECT_GE(weights[0], 0.49) << x;
  }
}

TEST(InverseSquareWeights, NeedAnAnchor) {
  EXPECT_THROW(inverse_square_weights({}, {0, 0}), BrokenPrecondition);
}

}  // namespace
}  // namespace crowdface
