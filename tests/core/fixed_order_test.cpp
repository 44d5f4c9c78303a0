// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/fixed_order.h"

#include <vector>

#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/core/require.h"

namespace crowdface {
namespace {

using Rows = std::vector<std::vector<double>>;

TEST(Cholesky, FactorTimesItsTransposeIsTheMatrix) {
  const Rows a = {{4, 2, -1}, {2, 5, 3}, {-1, 3, 6}};
  const Rows lower = cholesky(a, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k <= j; ++k) sum += lower[i][k] * lower[j][k];
      EXPECT_NEAR(sum, a[i][j], 1e-14);
    }
  }
  const std::vector<double> x = solve_lower(lower, std::vector<double>{1, -2, 3}, 3);
  const double back[3] = {lower[0][0] * x[0], lower[1][0] * x[0] + lower[1][1] * x[1],
                          lower[2][0] * x[0] + lower[2][1] * x[1] + lower[2][2] * x[2]};
  EXPECT_NEAR(back[0], 1, 1e-14);
  EXPECT_NEAR(back[1], -2, 1e-14);
  EXPECT_NEAR(back[2], 3, 1e-14);
}

TEST(Orthonormalize, LeavesAUnitVectorAcrossTheOthers) {
  const std::vector<double> x = {0.6, 0.8, 0};
  std::vector<double> v = {1, 2, 2};
  double along = 0;
  const double left = orthonormalize(
      v, 1, [&](std::size_t) { return std::span(x); }, [&](std::size_t, double p) { along += p; });
  EXPECT_NEAR(along, 2.2, 1e-15);
  EXPECT_NEAR(fixed_order_dot(v, x), 0, 1e-15);
  EXPECT_NEAR(fixed_order_dot(v, v), 1, 1e-15);
  EXPECT_NEAR(left * left + along * along, 9, 1e-14);
}

TEST(Require, WhatIsBrokenIsOurMistakeAndNoUsersError) {
  EXPECT_NO_THROW(require(true, "fine"));
  try {
    require(false, "tiles: ", 5, " positions, ", 6, " vertices");
    FAIL();
  } catch (const RecoverableError&) {
    FAIL() << "would end with a code of the user's";
  } catch (const Error& error) {  // which a host catches
    EXPECT_EQ(error.code(), ExitCode::kBug);
    EXPECT_STREQ(error.what(), "tiles: 5 positions, 6 vertices");
  }
}

}  // namespace
}  // namespace crowdface
