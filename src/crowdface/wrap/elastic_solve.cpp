// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/elastic_solve.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

constexpr double kMinCotangent = 0.05;
constexpr std::ptrdiff_t kElasticBlock = 2048;

double product(const Positions& a, const Positions& b) {
  return parallel_dot(a.data(), b.data(), a.size(), 3 * kElasticBlock);
}

/// Adds factor · b to `a`.
void add_scaled(Positions& a, double factor, const Positions& b) {
  for (Index i = 0; i < a.size(); ++i) a.data()[i] += factor * b.data()[i];
}

SparseMatrix with_diagonal(SparseMatrix matrix, const Eigen::VectorXd& diagonal) {
  for (Index i = 0; i < matrix.rows(); ++i) matrix.coeffRef(i, i) += diagonal(i);
  return matrix;
}

/// L D Lᵀ factorisation of a symmetric matrix. Solves for three right-hand sides at once, because
/// most of the time is spent on reading L.
class Factors {
 public:
  explicit Factors(const SparseMatrix& matrix) {
    const Eigen::SimplicialLDLT<SparseMatrix> factors(matrix);
    if (factors.info() != Eigen::Success) {
      throw Error(ExitCode::kBug, "the stiffness of a skin cannot be factorised");
    }
    lower_ = factors.matrixL().nestedExpression();
    inverse_ = factors.vectorD().cwiseInverse();
    permutation_ = factors.permutationP().indices();
  }

  Positions solve(const Positions& right) const {
    const Index count = right.rows();
    Rows x(count, 4);
    x.col(3).setZero();
    for (Index i = 0; i < count; ++i) x.row(permutation_(i)).head<3>() = right.row(i);
    for (Index j = 0; j < count; ++j) {
      const Eigen::RowVector4d row = x.row(j);
      for (Column entry(lower_, j); entry; ++entry) x.row(entry.row()) -= entry.value() * row;
    }
    for (Index j = count; j-- > 0;) {
      Eigen::RowVector4d row = inverse_(j) * x.row(j);
      for (Column entry(lower_, j); entry; ++entry) row -= entry.value() * x.row(entry.row());
      x.row(j) = row;
    }
    Positions result(count, 3);
    for (Index i = 0; i < count; ++i) result.row(i) = x.row(permutation_(i)).head<3>();
    return result;
  }

 private:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
  using Column = SparseMatrix::InnerIterator;

  SparseMatrix lower_;  ///< L without its diagonal, whose entries are 1
  Eigen::VectorXd inverse_;
  Eigen::VectorXi permutation_;  ///< for each row of the matrix: the index of this row in L
};

}  // namespace

Eigen::VectorXd vertex_areas(const std::vector<Triangle>& triangles, const Positions& positions) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(positions.rows());
  double sum = 0;
  for (const Triangle& t : triangles) {
    const double area = area_vector(positions, t).norm() / 2;
    for (const std::uint32_t v : t) areas(v) += area / 3;
    sum += area;
  }
  constexpr double kMin = 1e-3;
  const double least = kMin * sum / static_cast<double>(std::max<Index>(1, positions.rows()));
  for (double& area : areas) area = std::max(area, least);
  return areas;
}

SparseMatrix laplacian(const std::vector<Triangle>& triangles, const Positions& positions) {
  using Entry = Eigen::Triplet<double>;
  std::vector<Entry> entries;
  entries.reserve(12 * triangles.size());
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<int>(t[(k + 1) % 3]), j = static_cast<int>(t[(k + 2) % 3]);
      const Eigen::Vector3d apex = row3(positions, t[k]);
      const Eigen::Vector3d a = row3(positions, i) - apex, b = row3(positions, j) - apex;
      const double area = a.cross(b).norm();
      const double cotangent = area > 0 ? std::min(a.dot(b) / area, 1 / kMinCotangent) : 0;
      const double weight = std::max(cotangent, kMinCotangent) / 2;
      entries.insert(entries.end(), {Entry(i, j, weight), Entry(j, i, weight), Entry(i, i, -weight),
                                     Entry(j, j, -weight)});
    }
  }
  SparseMatrix matrix(positions.rows(), positions.rows());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

SparseMatrix bending_energy(const SparseMatrix& laplacian, const Eigen::VectorXd& areas,
                            const Eigen::VectorXd& stiffness) {
  const Eigen::VectorXd weights = stiffness.cwiseQuotient(areas);
  return laplacian.transpose() * weights.asDiagonal() * laplacian;
}

void DataTerms::add(std::uint32_t vertex, const Eigen::Vector3d& normal, double normal_weight,
                    double isotropic_weight, const Eigen::Vector3d& offset) {
  Eigen::Matrix3d weight = normal_weight * normal * normal.transpose();
  weight.diagonal().array() += isotropic_weight;
  matrices[vertex] += weight;
  right_hand_side.row(vertex) += (weight * offset).transpose();
}

struct ElasticSolver::State {
  SparseMatrix stiffness;
  Factors factors;

  /// Returns (W + B) x, where W is the block-diagonal matrix of the data terms and B is
  /// `stiffness`. Reads B by columns: because B is symmetric, each column equals the row with the
  /// same index.
  Positions times(const DataTerms& data_terms, const Positions& x) const {
    Positions y(x.rows(), 3);
    parallel_for_each(x.rows(), kElasticBlock, [&](Index i) {
      Eigen::RowVector3d sum =
          x.row(i) * data_terms.matrices[static_cast<std::size_t>(i)];  // symmetric
      for (SparseMatrix::InnerIterator entry(stiffness, i); entry; ++entry) {
        sum += entry.value() * x.row(entry.row());
      }
      y.row(i) = sum;
    });
    return y;
  }
};

ElasticSolver::ElasticSolver(const SparseMatrix& stiffness, const Eigen::VectorXd& typical)
    : state_(new State{stiffness, Factors(with_diagonal(stiffness, typical))}) {}
ElasticSolver::~ElasticSolver() = default;

void ElasticSolver::solve(const DataTerms& data_terms, const Limits& limits,
                          Positions& displacements) const {
  Positions residual = data_terms.right_hand_side;
  add_scaled(residual, -1, state_->times(data_terms, displacements));
  Positions preconditioned = state_->factors.solve(residual);
  Positions direction = preconditioned;
  double rho = product(residual, preconditioned);
  const double enough =
      limits.tolerance * limits.tolerance *
      product(data_terms.right_hand_side, state_->factors.solve(data_terms.right_hand_side));
  for (int k = 0; k < limits.max_steps && rho > enough; ++k) {
    throw_if_interrupted();
    const Positions image = state_->times(data_terms, direction);
    const double curvature = product(direction, image);
    if (!(curvature > 0)) return;
    const double length = rho / curvature;
    add_scaled(displacements, length, direction);
    add_scaled(residual, -length, image);
    preconditioned = state_->factors.solve(residual);
    const double next = product(residual, preconditioned);
    const double ratio = next / rho;
    rho = next;
    for (Index i = 0; i < direction.size(); ++i) {
      direction.data()[i] = preconditioned.data()[i] + ratio * direction.data()[i];
    }
  }
}

}  // namespace crowdface
