// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/core/random.h"
#include "crowdface/wrap/elastic_solve.h"
#include "crowdface/wrap/scan.h"

#include "support/meshes.h"

namespace crowdface::testing {
namespace {

/// A sheet of n by n quads over the unit square.
Positions sheet(std::uint32_t n) {
  Positions positions((n + 1) * (n + 1), 3);
  for (std::uint32_t i = 0; i < positions.rows(); ++i) {
    const std::uint32_t column = i % (n + 1), row = i / (n + 1);
    positions.row(i) << static_cast<double>(column) / n, static_cast<double>(row) / n, 0;
  }
  return positions;
}

SparseMatrix energy_of(std::uint32_t n) {
  const std::vector<Triangle> triangles = triangles_of(grid_topology(n, n));
  const Positions positions = sheet(n);
  const Eigen::VectorXd areas = vertex_areas(triangles, positions);
  return bending_energy(laplacian(triangles, positions), areas,
                        Eigen::VectorXd::Ones(areas.size()));
}

TEST(Bending, ShiftsCostNothingAndWavesTheSameAtEveryResolution) {
  const auto cost = [](std::uint32_t n) {
    const Positions positions = sheet(n);
    // Flat along all rims, so that only the bending inside counts: (x(1−x))³ (y(1−y))³.
    const Eigen::ArrayXd x = positions.col(0).array(), y = positions.col(1).array();
    const Eigen::VectorXd wave = (x * (1 - x) * y * (1 - y)).cube();
    const SparseMatrix energy = energy_of(n);
    EXPECT_NEAR((energy * Eigen::VectorXd::Ones(wave.size())).norm(), 0, 1e-6);
    return wave.dot(energy * wave);
  };
  EXPECT_NEAR(cost(40) / cost(80), 1, 0.02);
}

TEST(Bending, AreasAddUp) {
  EXPECT_NEAR(vertex_areas(triangles_of(grid_topology(7, 7)), sheet(7)).sum(), 1, 1e-12);
}

TEST(ElasticSolve, GivesWhatADenseSolutionGives) {
  const SparseMatrix energy = 1e-3 * energy_of(8);
  const auto count = static_cast<std::uint32_t>(energy.rows());
  DataTerms data_terms(count);
  const Positions normals = random_positions(count, 1), offsets = random_positions(count, 2);
  for (std::uint32_t v = 0; v < count; ++v) {
    data_terms.add(v, normals.row(v).normalized().transpose(), 0.7, v % 3 == 0 ? 0.3 : 0.01,
                   offsets.row(v).transpose());
  }
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(3 * count, 3 * count);
  Eigen::VectorXd right(3 * count);
  for (std::uint32_t i = 0; i < count; ++i) {
    whole.block<3, 3>(3 * i, 3 * i) += data_terms.matrices[i];
    right.segment<3>(3 * i) = data_terms.right_hand_side.row(i).transpose();
    for (std::uint32_t j = 0; j < count; ++j) {
      whole.block<3, 3>(3 * i, 3 * j).diagonal().array() += energy.coeff(i, j);
    }
  }
  const Eigen::VectorXd expected = whole.ldlt().solve(right);
  const ElasticSolver solver(energy, Eigen::VectorXd::Constant(count, 0.5));
  Positions found = Positions::Zero(count, 3);
  solver.solve(data_terms, {.max_steps = 300, .tolerance = 1e-12}, found);
  for (std::uint32_t v = 0; v < count; ++v) {
    EXPECT_LT((found.row(v).transpose() - expected.segment<3>(3 * v)).norm(), 1e-8);
  }
}

TEST(ElasticSolve, OneThreadGivesWhatManyGive) {
  const SparseMatrix energy = 1e-3 * energy_of(60);
  const auto count = static_cast<std::uint32_t>(energy.rows());
  DataTerms data_terms(count);
  const Positions offsets = random_positions(count, 2);
  for (std::uint32_t v = 0; v < count; ++v) {
    data_terms.add(v, Eigen::Vector3d::UnitZ(), 1, 0.3, offsets.row(v).transpose());
  }
  const auto solve = [&](int threads) {
    const ThreadLimit limit(threads);
    Positions found = Positions::Zero(count, 3);
    ElasticSolver(energy, Eigen::VectorXd::Constant(count, 0.5)).solve(data_terms, {}, found);
    return found;
  };
  EXPECT_EQ(solve(1), solve(4));
}

}  // namespace
}  // namespace crowdface::testing
