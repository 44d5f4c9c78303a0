// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/quadratic_program.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

using Vector = QuadraticProgram::Vector;

double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Numbers in [−1, 1] without a pattern.
double scatter(int i, int j, int k) {
  const double x = std::sin(12.9898 * i + 78.233 * j + 37.719 * k + 1) * 43758.5453;
  return 2 * (x - std::floor(x)) - 1;
}

TEST(QuadraticProgram, WithoutBoundsIsLeastSquares) {
  QuadraticProgram program(2);
  program.add_target(0, 3, 1);
  program.add_target(1, -1, 1);
  program.add_target({1, 1}, 6, 2);
  // Two thirds of 4 each, since (1, 1) has a weight of 2 · 2 against 1.
  const Vector x = program.solve(1e-12);
  EXPECT_NEAR(x[0], 3 + 8.0 / 5, 1e-12);
  EXPECT_NEAR(x[1], -1 + 8.0 / 5, 1e-12);
}

TEST(QuadraticProgram, FindsWhatSlowAscentFinds) {
  constexpr int kUnknowns = 5, kBounds = 60, kSweeps = 20000;
  for (int problem = 0; problem < 20; ++problem) {
    QuadraticProgram program(kUnknowns);
    Vector wanted = {};
    for (int i = 0; i < kUnknowns; ++i) {
      wanted[static_cast<std::size_t>(i)] = 3 * scatter(problem, i, 0);
      program.add_target(static_cast<std::size_t>(i), wanted[static_cast<std::size_t>(i)], 1);
    }
    std::vector<Vector> normals;
    std::vector<double> least;
    for (int b = 0; b < kBounds; ++b) {
      Vector a = {};
      for (int i = 0; i < kUnknowns; ++i)
        a[static_cast<std::size_t>(i)] = scatter(problem, i, b + 1);
      normals.push_back(a);
      least.push_back(-0.5 - std::abs(scatter(problem, 9, b)));  // zero satisfies them
      program.add_lower_bound(a, least.back());
    }
    const Vector x = program.solve(1e-10);
    // Hildreth's: one bound after the other, until none moves any more.
    Vector y = wanted;
    std::vector<double> force(kBounds, 0);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (std::size_t b = 0; b < normals.size(); ++b) {
        const double change =
            std::max(-force[b], (least[b] - dot(normals[b], y)) / dot(normals[b], normals[b]));
        force[b] += change;
        for (std::size_t i = 0; i < y.size(); ++i) y[i] += change * normals[b][i];
      }
    }
    for (std::size_t i = 0; i < kUnknowns; ++i) EXPECT_NEAR(x[i], y[i], 1e-6) << problem;
  }
}

TEST(QuadraticProgram, PaysForWhatCannotBeHadOnlyWhatItMust) {
  QuadraticProgram program(2);
  program.add_target(0, 0, 1);
  program.add_slack(1, 100);
  program.add_lower_bound({1, 1}, 1);   // at least 1 …
  program.add_lower_bound({-1, 1}, 0);  // … and at most 0, with a slack
  const Vector x = program.solve(1e-12);
  EXPECT_NEAR(x[0], 0.5, 1e-9);
  EXPECT_NEAR(x[1], 0.5, 1e-9);
}

// The table of active bounds was written beyond its end. A bound that is no number ends the search
// where it is: at the optimum without bounds.
TEST(QuadraticProgram, EndsAtABoundThatIsNoNumber) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const Vector& normal : {Vector{1, 0.5}, Vector{kNan, 1}}) {
    QuadraticProgram program(2);
    program.add_target(0, 3, 1);
    program.add_target(1, -2, 1);
    program.add_lower_bound(Vector{1, 0}, 4);
    program.add_lower_bound(normal, kNan);
    const Vector x = program.solve(1e-9);
    EXPECT_EQ(x[0], 3);
    EXPECT_EQ(x[1], -2);
  }
}

TEST(QuadraticProgram, EndsWhereNothingSatisfiesAll) {
  QuadraticProgram program(1);
  program.add_target(0, 0.2, 1);
  program.add_lower_bound(Vector{1}, 1);
  program.add_lower_bound(Vector{-1}, 0);
  EXPECT_TRUE(std::isfinite(program.solve(1e-9)[0]));
}

}  // namespace
}  // namespace crowdface
