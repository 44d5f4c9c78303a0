// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/elastic_solve.h"

#include <cmath>

#include <Eigen/SparseCholesky>

#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

constexpr std::ptrdiff_t kBlock = 2048;

double product(const Positions& a, const Positions& b) {
  return parallel_dot(a.data(), b.data(), a.size(), 3 * kBlock);
}

/// a += factor · b
void add_scaled(Positions& a, double factor, const Positions& b) {
  for (Index i = 0; i < a.size(); ++i) a.data()[i] += factor * b.data()[i];
}

}  // namespace

void Wishes::add(std::uint32_t vertex, const Eigen::Vector3d& normal, double along, double all,
                 const Eigen::Vector3d& offset) {
  Eigen::Matrix3d weight = along * normal * normal.transpose();
  weight.diagonal().array() += all;
  matrices[vertex] += weight;
  right.row(vertex) += (weight * offset).transpose();
}

struct ElasticSolver::State {
  SparseMatrix stiffness;
  Eigen::SimplicialLDLT<SparseMatrix> factors;

  /// (W + B) x; B is symmetric, so that a column is a row.
  Positions times(const Wishes& wishes, const Positions& x) const {
    Positions y(x.rows(), 3);
    parallel_for_each(x.rows(), kBlock, [&](Index i) {
      Eigen::RowVector3d sum =
          x.row(i) * wishes.matrices[static_cast<std::size_t>(i)];  // symmetric
      for (SparseMatrix::InnerIterator entry(stiffness, i); entry; ++entry) {
        sum += entry.value() * x.row(entry.row());
      }
      y.row(i) = sum;
    });
    return y;
  }

  Positions precondition(const Positions& residual) const {
    Positions result(residual.rows(), 3);
    parallel_for_each(3, [&](auto c) {
      const Eigen::VectorXd column = residual.col(c);
      result.col(c) = factors.solve(column);
    });
    return result;
  }
};

ElasticSolver::ElasticSolver(const SparseMatrix& stiffness, const Eigen::VectorXd& typical)
    : state_(std::make_unique<State>()) {
  SparseMatrix matrix = stiffness;
  for (Index i = 0; i < matrix.rows(); ++i) matrix.coeffRef(i, i) += typical(i);
  state_->stiffness = stiffness;
  state_->factors.compute(matrix);
  if (state_->factors.info() != Eigen::Success) {
    throw Error(ExitCode::kBug, "the stiffness of a skin cannot be factorised");
  }
}
ElasticSolver::~ElasticSolver() = default;

void ElasticSolver::solve(const Wishes& wishes, const Limits& limits,
                          Positions& displacements) const {
  Positions residual = wishes.right;
  add_scaled(residual, -1, state_->times(wishes, displacements));
  Positions preconditioned = state_->precondition(residual);
  Positions direction = preconditioned;
  double rho = product(residual, preconditioned);
  const double enough = limits.tolerance * limits.tolerance *
                        product(wishes.right, state_->precondition(wishes.right));
  for (int k = 0; k < limits.steps && rho > enough; ++k) {
    throw_if_interrupted();
    const Positions image = state_->times(wishes, direction);
    const double curvature = product(direction, image);
    if (!(curvature > 0)) return;
    const double length = rho / curvature;
    add_scaled(displacements, length, direction);
    add_scaled(residual, -length, image);
    preconditioned = state_->precondition(residual);
    const double next = product(residual, preconditioned);
    const double ratio = next / rho;
    rho = next;
    for (Index i = 0; i < direction.size(); ++i) {
      direction.data()[i] = preconditioned.data()[i] + ratio * direction.data()[i];
    }
  }
}

}  // namespace crowdface
