// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/symmetric_eigen.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace crowdface {
namespace {

using Eigen::Index;

struct Rotation {
  double cosine = 1, sine = 0;
};

/// The Jacobi rotation that zeroes the elements (p, q) and (q, p).
Rotation jacobi_rotation(const Eigen::MatrixXd& a, Index p, Index q) {
  if (a(p, q) == 0) return {};
  const double tau = (a(q, q) - a(p, p)) / (2 * a(p, q));
  const double tangent = (tau >= 0 ? 1.0 : -1.0) / (std::abs(tau) + std::sqrt(1 + tau * tau));
  const double cosine = 1 / std::sqrt(1 + tangent * tangent);
  return {cosine, tangent * cosine};
}

void rotate_columns(Eigen::MatrixXd& a, Index p, Index q, Rotation r) {
  for (Index i = 0; i < a.rows(); ++i) {
    const double left = a(i, p), right = a(i, q);
    a(i, p) = r.cosine * left - r.sine * right;
    a(i, q) = r.sine * left + r.cosine * right;
  }
}

void rotate_rows(Eigen::MatrixXd& a, Index p, Index q, Rotation r) {
  for (Index i = 0; i < a.cols(); ++i) {
    const double above = a(p, i), below = a(q, i);
    a(p, i) = r.cosine * above - r.sine * below;
    a(q, i) = r.sine * above + r.cosine * below;
  }
}

double off_diagonal(const Eigen::MatrixXd& a) {
  double largest = 0;
  for (Index p = 0; p < a.rows(); ++p) {
    for (Index q = 0; q < p; ++q) largest = std::max(largest, std::abs(a(p, q)));
  }
  return largest;
}

}  // namespace

SymmetricEigen symmetric_eigen(Eigen::MatrixXd matrix) {
  const Index size = matrix.rows();
  Eigen::MatrixXd vectors = Eigen::MatrixXd::Identity(size, size);
  const double small = 1e-16 * std::max(matrix.cwiseAbs().maxCoeff(), 1e-300);
  constexpr int kMaxSweeps = 60;  // few sweeps suffice: convergence is quadratic
  for (int sweep = 0; sweep < kMaxSweeps && off_diagonal(matrix) > small; ++sweep) {
    for (Index p = 0; p < size; ++p) {
      for (Index q = p + 1; q < size; ++q) {
        const Rotation rotation = jacobi_rotation(matrix, p, q);
        rotate_columns(matrix, p, q, rotation);
        rotate_rows(matrix, p, q, rotation);
        rotate_columns(vectors, p, q, rotation);
      }
    }
  }
  std::vector<Index> order(static_cast<std::size_t>(size));
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, [&](Index a, Index b) { return matrix(a, a) > matrix(b, b); });
  SymmetricEigen result{Eigen::VectorXd(size), Eigen::MatrixXd(size, size)};
  for (Index i = 0; i < size; ++i) {
    const Index from = order[static_cast<std::size_t>(i)];
    result.eigenvalues(i) = matrix(from, from);
    result.eigenvectors.col(i) = vectors.col(from);
  }
  return result;
}

}  // namespace crowdface
