// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/level_basis.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "crowdface/core/instruction_set.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/smooth/iterate.h"
#include "crowdface/smooth/symmetric_eigen.h"

#include "support/expect_error.h"
#include "support/levels.h"
#include "support/meshes.h"

namespace crowdface {
namespace {

using testing::grid_topology;
using testing::random_positions;

/// A hill with ripples and some noise: waves of every length, as a face has.
Positions hill(Index columns, Index rows) {
  Positions positions(columns * rows, 3);
  const Positions noise = random_positions(positions.rows(), 4);
  for (Index i = 0; i < positions.rows(); ++i) {
    const double x = static_cast<double>(i % columns), y = static_cast<double>(i / columns);
    const double cx = x / static_cast<double>(columns) - 0.5,
                 cy = y / static_cast<double>(rows) - 0.5;
    const double height = 6 * std::exp(-8 * (cx * cx + cy * cy)) +
                          0.3 * std::sin(0.9 * x) * std::cos(0.7 * y) + 0.1 * std::sin(2.1 * x + y);
    positions.row(i) << 0.3 * x, 0.3 * y, height;
    positions.row(i) += 0.01 * noise.row(i);
  }
  return positions;
}

struct Fitted {
  Topology topology = grid_topology(59, 47);
  Positions positions = hill(60, 48);
  SmoothingOperator smoothing;
  ChebyshevFilter filter;
  LevelNodes nodes;
  NodeFields fields;
  explicit Fitted(OperatorKind kind, std::uint64_t max_level = 400,
                  Boundary boundary = Boundary::kFixed)
      : smoothing(build_adjacency(topology), boundary, kind),
        filter(smoothing, positions),
        nodes(kind, max_level),
        fields(filter_nodes(filter, nodes, positions)) {}
};

class NodesOf : public ::testing::TestWithParam<OperatorKind> {};

TEST_P(NodesOf, RepresentEveryEigenvectorAtEveryLevel) {
  for (const std::uint64_t max_level : {1U, 2U, 7U, 100U, 3000U}) {
    const LevelNodes nodes(GetParam(), max_level);
    EXPECT_EQ(nodes.levels().back(), max_level);
    EXPECT_LE(nodes.levels().size(), 40U);
    for (std::uint64_t level = 0; level <= max_level; level += 1 + max_level / 97) {
      const std::vector<double> weights = nodes.interpolation_weights(level);
      const double lowest = GetParam() == OperatorKind::kLazy ? 0 : -1;
      for (double x = lowest; x <= 1; x += 1.0 / 256) {
        double sum = 0;
        for (std::size_t n = 0; n < weights.size(); ++n) {
          sum += weights[n] * (std::pow(x, static_cast<double>(nodes.levels()[n])) - 1);
        }
        EXPECT_NEAR(sum, std::pow(x, static_cast<double>(level)) - 1, 0.02)
            << x << ' ' << level << " of " << max_level;
      }
    }
  }
}

TEST_P(NodesOf, AreMetExactlyAndNothingHappensAtZero) {
  const LevelNodes nodes(GetParam(), 1000);
  for (std::size_t n = 0; n < nodes.levels().size(); ++n) {
    std::vector<double> unit(nodes.levels().size(), 0.0);
    unit[n] = 1;
    EXPECT_EQ(nodes.interpolation_weights(nodes.levels()[n]), unit);
  }
  EXPECT_EQ(nodes.interpolation_weights(0), std::vector<double>(nodes.levels().size(), 0.0));
  EXPECT_THROW(nodes.interpolation_weights(1001), BrokenPrecondition);
}

TEST_P(NodesOf, LetNoWeightGrowLarge) {
  const LevelNodes nodes(GetParam(), 20000);
  for (std::uint64_t level = 1; level <= 20000; level += 61) {
    for (const double weight : nodes.interpolation_weights(level))
      EXPECT_LT(std::abs(weight), 2) << level;
  }
}

INSTANTIATE_TEST_SUITE_P(Operators, NodesOf,
                         ::testing::Values(OperatorKind::kUmbrella, OperatorKind::kLazy));

class Basis : public ::testing::TestWithParam<std::tuple<OperatorKind, Boundary>> {};

/// The promise, over all levels and not only the tested ones.
TEST_P(Basis, StaysWithinItsToleranceAtEveryLevelAndVertex) {
  const auto [kind, boundary] = GetParam();
  const Fitted fitted(kind, 400, boundary);
  for (const double tolerance : {0.05, 0.005}) {
    const LevelBasis basis = fit_level_basis(fitted.filter, fitted.nodes, fitted.fields, tolerance);
    EXPECT_LE(basis.error.max, tolerance);
    EXPECT_LE(basis.error.rms, basis.error.max);
    double largest = 0;
    Columns level = fitted.positions;  // by plain iteration
    for (std::uint64_t l = 0; l <= 400; ++l) {
      if (l > 0) level = iterate(fitted.smoothing, level, 1);
      const Positions found = testing::evaluate(basis, fitted.nodes, fitted.positions, l);
      largest = std::max(largest, (found - level).rowwise().norm().maxCoeff());
    }
    EXPECT_LE(largest, basis.error.max * 1.02) << "what it says of itself, between levels too";
    EXPECT_GT(largest, basis.error.max / 4) << "the bound is no empty one";
  }
}

/// The same at the length of the paper's runs, every single level of 20,000, at a share of the
/// vertices.
TEST(LevelBasis, StaysWithinItsToleranceAtEveryLevelOfALongRun) {
  constexpr std::uint64_t kMaxLevel = 20'000;
  const Fitted fitted(OperatorKind::kUmbrella, kMaxLevel);
  const LevelBasis basis = fit_level_basis(fitted.filter, fitted.nodes, fitted.fields, 0.01);
  double largest = 0;
  std::uint64_t where = 0;
  Columns level = fitted.positions;  // by plain iteration
  for (std::uint64_t l = 1; l <= kMaxLevel; ++l) {
    level = iterate(fitted.smoothing, level, 1);
    const std::vector<double> phi =
        level_function_values(fitted.nodes, basis.function_coefficients, l);
    for (Index v = static_cast<Index>(l % 7); v < level.rows(); v += 7) {
      Eigen::RowVector3d found = fitted.positions.row(v);
      for (Index p = 0; p < basis.rank(); ++p) {
        for (Index c = 0; c < 3; ++c) {
          found[c] += phi[static_cast<std::size_t>(p)] * basis.fields.value(p, v, c);
        }
      }
      const double missed = (found - level.row(v)).norm();
      if (missed > largest) {
        largest = missed;
        where = l;
      }
    }
  }
  EXPECT_LE(largest, basis.error.max * 1.02) << "at level " << where;
  EXPECT_GT(largest, basis.error.max / 4) << "the bound is no empty one";
}

TEST_P(Basis, LevelZeroAndRimsKeepTheirBits) {
  const auto [kind, boundary] = GetParam();
  const Fitted fitted(kind, 300, boundary);
  const LevelBasis basis = fit_level_basis(fitted.filter, fitted.nodes, fitted.fields, 0.02);
  EXPECT_EQ(testing::evaluate(basis, fitted.nodes, fitted.positions, 0), fitted.positions);
  const Positions moved = testing::evaluate(basis, fitted.nodes, fitted.positions, 111);
  for (Index i = 0; i < moved.rows(); ++i) {
    if (fitted.smoothing.neighbours(i).empty()) {
      EXPECT_EQ(moved.row(i), fitted.positions.row(i)) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllOperators, Basis,
                         ::testing::Combine(::testing::Values(OperatorKind::kUmbrella,
                                                              OperatorKind::kLazy),
                                            ::testing::Values(Boundary::kFixed, Boundary::kFree)));

TEST(LevelBasis, HasFewerFieldsWhereMoreIsForgiven) {
  const Fitted fitted(OperatorKind::kUmbrella);
  const auto rank = [&](double tolerance) {
    return fit_level_basis(fitted.filter, fitted.nodes, fitted.fields, tolerance).rank();
  };
  EXPECT_LT(rank(0.5), rank(0.05));
  EXPECT_LT(rank(0.05), rank(0.005));
}

TEST(LevelBasis, FollowsACheckerboardThroughBothParities) {
  // A pattern that the undamped mean flips for ever: half of the levels show it, half its negative.
  Topology topology = grid_topology(40, 40);
  const SmoothingOperator smoothing(build_adjacency(topology), Boundary::kFree,
                                    OperatorKind::kUmbrella);
  Positions positions = Positions::Zero(41 * 41, 3);
  for (Index i = 0; i < positions.rows(); ++i) {
    const Index x = i % 41, y = i / 41;
    positions.row(i) << 0.1 * static_cast<double>(x), 0.1 * static_cast<double>(y),
        (x + y) % 2 == 0 ? 0.05 : -0.05;
  }
  const ChebyshevFilter filter(smoothing, positions);
  const LevelNodes nodes(OperatorKind::kUmbrella, 500);
  const LevelBasis basis =
      fit_level_basis(filter, nodes, filter_nodes(filter, nodes, positions), 0.005);
  for (const std::uint64_t level : {1U, 2U, 33U, 34U, 301U, 402U, 499U}) {
    const double difference =
        (testing::evaluate(basis, nodes, positions, level) - smooth(filter, positions, level))
            .rowwise()
            .norm()
            .maxCoeff();
    EXPECT_LT(difference, 0.0051) << level;
  }
}

TEST(LevelBasis, HasTheSameBitsOnAnyMachine) {
  const Fitted fitted(OperatorKind::kUmbrella);
  const LevelBasis expected = fit_level_basis(fitted.filter, fitted.nodes, fitted.fields, 0.01);
  const auto expect_same = [&] {
    const NodeFields fields = filter_nodes(fitted.filter, fitted.nodes, fitted.positions);
    const LevelBasis basis = fit_level_basis(fitted.filter, fitted.nodes, fields, 0.01);
    EXPECT_EQ(basis.function_coefficients, expected.function_coefficients);
    EXPECT_TRUE(
        std::ranges::equal(basis.fields.first_field_of_tile, expected.fields.first_field_of_tile));
    EXPECT_TRUE(
        std::ranges::equal(basis.fields.quantization_steps, expected.fields.quantization_steps));
    EXPECT_TRUE(
        std::ranges::equal(basis.fields.quantized_values, expected.fields.quantized_values));
    EXPECT_EQ(basis.error.max, expected.error.max);
    EXPECT_EQ(basis.error.rms, expected.error.rms);
    EXPECT_EQ(basis.error.level, expected.error.level);
  };
  for (const std::string& name : instruction_sets()) {
    SCOPED_TRACE(name);
    use_instruction_set(name);
    expect_same();
  }
  use_instruction_set(instruction_sets().front());
  const ThreadLimit one(1);
  expect_same();
}

TEST(LevelBasis, RefusesAToleranceThatSinglePrecisionCannotHold) {
  const Fitted fitted(OperatorKind::kUmbrella);
  testing::expect_error(ExitCode::kBadData, {"smoothing.tolerance: expected", "reached"},
                        [&] { fit_level_basis(fitted.filter, fitted.nodes, fitted.fields, 1e-9); });
}

TEST(SymmetricEigen, DiagonalisesWithOrthonormalVectors) {
  const Positions noise = random_positions(27, 1);
  Eigen::MatrixXd a(9, 9);
  for (Index i = 0; i < 81; ++i) a(i / 9, i % 9) = noise(i / 3, i % 3);
  const Eigen::MatrixXd matrix = a + a.transpose();
  const SymmetricEigen eigen = symmetric_eigen(matrix);
  EXPECT_LT((eigen.eigenvectors.transpose() * eigen.eigenvectors - Eigen::MatrixXd::Identity(9, 9))
                .cwiseAbs()
                .maxCoeff(),
            1e-13);
  EXPECT_LT((eigen.eigenvectors * eigen.eigenvalues.asDiagonal() * eigen.eigenvectors.transpose() -
             matrix)
                .cwiseAbs()
                .maxCoeff(),
            1e-13);
  for (Index i = 1; i < 9; ++i) EXPECT_GE(eigen.eigenvalues(i - 1), eigen.eigenvalues(i));
}

}  // namespace
}  // namespace crowdface
