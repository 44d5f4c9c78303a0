// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/cubic_fit.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "crowdface/smooth/iterate.h"
#include "crowdface/smooth/level_size.h"

#include "support/levels.h"
#include "support/meshes.h"

namespace crowdface {
namespace {

TEST(CubicFitLevels, AreAboutFortyAndDenseAtTheStart) {
  const auto levels = levels_dense_at_start(20000, kCubicFitSteps);
  EXPECT_EQ(levels.size(), 41U);
  EXPECT_EQ(levels.front(), 0U);
  EXPECT_EQ(levels.back(), 20000U);
  EXPECT_LT(levels[20] - levels[0], levels[40] - levels[20]);
  EXPECT_EQ(levels_dense_at_start(3, kCubicFitSteps), (std::vector<std::uint64_t>{0, 1, 2, 3}));
}

TEST(CubicFit, EqualsLeastSquaresOverStoredLevels) {
  const Topology topology = testing::grid_topology(8, 6);
  const SmoothingOperator smoothing(build_adjacency(topology), Boundary::kFixed,
                                    OperatorKind::kUmbrella);
  const Positions positions = testing::random_positions(topology.vertex_count, 1);
  constexpr std::uint64_t kMaxLevel = 200;
  const auto levels = levels_dense_at_start(kMaxLevel, kCubicFitSteps);
  const auto count = static_cast<Index>(levels.size());
  // The paper's way: store the levels, solve for each coordinate of each vertex.
  Eigen::MatrixXd design(count, 4), data(count, positions.size());
  for (Index l = 0; l < count; ++l) {
    const auto basis = cubic_basis(levels[static_cast<std::size_t>(l)], kMaxLevel);
    for (Index p = 0; p < 4; ++p) design(l, p) = basis[static_cast<std::size_t>(p)];
    const Positions moved =
        iterate(smoothing, positions, levels[static_cast<std::size_t>(l)]) - positions;
    data.row(l) = moved.reshaped<Eigen::RowMajor>().transpose();
  }
  const Eigen::MatrixXd expected = design.colPivHouseholderQr().solve(data);
  const CubicFit fit = fit_cubic(ChebyshevFilter(smoothing, positions), positions, kMaxLevel);
  for (Index p = 0; p < 4; ++p) {
    for (Index i = 0; i < positions.size(); ++i) {
      const std::size_t tile = static_cast<std::size_t>(i / 3) / kTileVertices;
      const double half_a_step =
          0.5 * static_cast<double>(
                    fit.fields.quantization_steps[4 * tile + static_cast<std::size_t>(p)]);
      EXPECT_NEAR(fit.fields.value(p, i / 3, i % 3), expected(p, i), half_a_step + 2e-6) << p;
    }
  }
}

TEST(CubicFit, IsExactWhereFourLevelsAreAll) {
  const Topology topology = testing::grid_topology(5, 5);
  const SmoothingOperator smoothing(build_adjacency(topology), Boundary::kFree,
                                    OperatorKind::kLazy);
  const Positions positions = testing::random_positions(topology.vertex_count, 2);
  const CubicFit fit = fit_cubic(ChebyshevFilter(smoothing, positions), positions, 3);
  double rounding = 0;  // t, t², t³ are at most 1
  for (const float step : fit.fields.quantization_steps)
    rounding += 0.5 * static_cast<double>(step);
  for (std::uint64_t level = 0; level <= 3; ++level) {
    EXPECT_LT((testing::evaluate(fit, positions, level) - iterate(smoothing, positions, level))
                  .cwiseAbs()
                  .maxCoeff(),
              rounding + 1e-5);
  }
  EXPECT_LT(rounding, 5e-4);
}

TEST(CubicFit, LeavesFixedVerticesWhereTheyAre) {
  const Topology topology = testing::grid_topology(6, 6);
  const SmoothingOperator smoothing(build_adjacency(topology), Boundary::kFixed,
                                    OperatorKind::kUmbrella);
  const Positions positions = testing::random_positions(topology.vertex_count, 3);
  const Positions moved = testing::evaluate(
      fit_cubic(ChebyshevFilter(smoothing, positions), positions, 100), positions, 60);
  for (Index i = 0; i < positions.rows(); ++i) {
    if (smoothing.neighbours(i).empty()) {
      EXPECT_LT((moved.row(i) - positions.row(i)).norm(), 1e-12);
    }
  }
}

}  // namespace
}  // namespace crowdface
