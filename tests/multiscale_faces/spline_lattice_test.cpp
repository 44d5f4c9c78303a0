// SPDX-License-Identifier: Apache-2.0
#include "multiscale_faces/spline_lattice.h"

#include <random>

#include <gtest/gtest.h>

namespace crowdface::multiscale {
namespace {

TextureCoordinates random_places(Index count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform;
  return TextureCoordinates::NullaryExpr(count, 2, [&] { return uniform(random); });
}

Columns wavy_values(const TextureCoordinates& uvs) {
  Columns values(uvs.rows(), 2);
  values.col(0) = (9 * uvs.col(0)).array().sin() * (7 * uvs.col(1)).array().cos();
  values.col(1) = (13 * (uvs.col(0) + uvs.col(1))).array().sin();
  return values;
}

double largest_error(const SplineLattice& lattice, const TextureCoordinates& uvs,
                     const Columns& values) {
  double largest = 0;
  for (Index s = 0; s < uvs.rows(); ++s) {
    largest = std::max(largest, (lattice.value(uvs.row(s)) - values.row(s)).norm());
  }
  return largest;
}

TEST(SplineLattice, IsAPartitionOfUnity) {
  for (const Index spans : {1, 2, 5, 64}) {
    const SplineLattice ones(spans, Columns::Ones((spans + 3) * (spans + 3), 1));
    for (const Eigen::RowVector2d& uv : {Eigen::RowVector2d(0, 0), {1, 1}, {0.3, 0.7}, {1, 0}}) {
      EXPECT_NEAR(ones.value(uv)[0], 1, 1e-14);
      EXPECT_NEAR(ones.value_and_derivatives(uv).bottomRows(2).norm(), 0, 1e-12);
    }
  }
}

/// A control point of a polynomial is its blossom at the three knots around it (Ramshaw 1987). For
/// x³ this is their product.
TEST(SplineLattice, ReproducesCubicPolynomials) {
  constexpr Index kSpans = 6, kSide = kSpans + 3;
  const auto cube = [](Index row) {
    const auto i = static_cast<double>(row - 1);
    return (i - 1) * i * (i + 1) / (kSpans * kSpans * kSpans);
  };
  Columns control(kSide * kSide, 1);
  for (Index j = 0; j < kSide; ++j) {
    for (Index i = 0; i < kSide; ++i) control(i + j * kSide, 0) = cube(i) * cube(j);
  }
  const SplineLattice lattice(kSpans, control);
  const TextureCoordinates uvs = random_places(200);
  for (Index s = 0; s < uvs.rows(); ++s) {
    const double u = uvs(s, 0), v = uvs(s, 1);
    const auto value_and_derivatives = lattice.value_and_derivatives(uvs.row(s));
    EXPECT_NEAR(value_and_derivatives(0, 0), u * u * u * v * v * v, 1e-13);
    EXPECT_NEAR(value_and_derivatives(1, 0), 3 * u * u * v * v * v, 1e-12);
    EXPECT_NEAR(value_and_derivatives(2, 0), 3 * u * u * u * v * v, 1e-12);
  }
}

TEST(SplineLattice, RefinedIsTheSameFunction) {
  const TextureCoordinates uvs = random_places(500);
  for (const Index spans : {1, 3, 8}) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const SplineLattice lattice(
        spans, Columns::NullaryExpr((spans + 3) * (spans + 3), 3, [&] { return normal(random); }));
    const SplineLattice refined = lattice.refined();
    EXPECT_EQ(refined.spans(), 2 * spans);
    for (Index s = 0; s < uvs.rows(); ++s) {
      EXPECT_NEAR((refined.value(uvs.row(s)) - lattice.value(uvs.row(s))).norm(), 0, 1e-13);
    }
  }
}

/// Eqs. 3 and 5 of Lee et al. for one sample: the smallest control points that give its value.
TEST(SplineLattice, GivesTheValueOfOneSampleWithTheSmallestControlPoints) {
  const TextureCoordinates uv = Eigen::RowVector2d(0.37, 0.81);
  const Columns value = Columns::Constant(1, 1, 5);
  const SplineLattice lattice = approximate(4, uv, value);
  EXPECT_NEAR(lattice.value(uv.row(0))[0], 5, 1e-13);
  // Any other solution adds a vector across the 16 weights and is longer.
  Columns other = lattice.control_points();
  Eigen::VectorXd weights(other.rows());
  for (Index row = 0; row < other.rows(); ++row) {
    Columns one = Columns::Zero(other.rows(), 1);
    one(row, 0) = 1;
    weights[row] = SplineLattice(4, one).value(uv.row(0))[0];
  }
  const Eigen::VectorXd along = weights * (5 / weights.squaredNorm());
  EXPECT_NEAR((other.col(0) - along).norm(), 0, 1e-12);
}

TEST(SplineLattice, EachLevelLeavesSmallerErrors) {
  const TextureCoordinates uvs = random_places(4000);
  const Columns values = wavy_values(uvs);
  double before = HUGE_VAL;
  const auto levels = approximate_by_levels(4, 256, uvs, values);
  ASSERT_EQ(levels.size(), 7U);
  for (const SplineLattice& level : levels) {
    const double error = largest_error(level, uvs, values);
    EXPECT_LT(error, before);
    before = error;
  }
  EXPECT_LT(before, 0.01);
}

}  // namespace
}  // namespace crowdface::multiscale
