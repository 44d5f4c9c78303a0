// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/span_basis.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "crowdface/cast/float_kernels.h"
#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

using Eigen::Index;

constexpr Index kNumbersAtATime = 1 << 16;

/// Diagonalizes a symmetric matrix A with the cyclic Jacobi method (Golub & Van Loan, Matrix
/// Computations, section 8.5).
///
/// \return  the eigenvectors of A, one per column, sorted by eigenvalue, largest first.
Eigen::MatrixXd eigenvectors_of_symmetric(Eigen::MatrixXd matrix) {
  constexpr int kMaxSweeps = 30;
  constexpr double kNegligible = 1e-12;  // of the trace
  const Index size = matrix.rows();
  Eigen::MatrixXd vectors = Eigen::MatrixXd::Identity(size, size);
  double trace = 0;
  for (Index i = 0; i < size; ++i) trace += matrix(i, i);
  bool is_diagonal = false;
  for (int sweep = 0; sweep < kMaxSweeps && !is_diagonal; ++sweep) {
    is_diagonal = true;
    for (Index p = 0; p < size; ++p) {
      for (Index q = p + 1; q < size; ++q) {
        if (std::abs(matrix(p, q)) <= kNegligible * trace) continue;
        is_diagonal = false;
        Eigen::JacobiRotation<double> rotation;
        rotation.makeJacobi(matrix, p, q);
        matrix.applyOnTheLeft(p, q, rotation.adjoint());
        matrix.applyOnTheRight(p, q, rotation);
        vectors.applyOnTheRight(p, q, rotation);
      }
    }
  }
  std::vector<Index> order(static_cast<std::size_t>(size));
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, std::greater<>(), [&](Index i) { return matrix(i, i); });
  return vectors(Eigen::all, order);
}

}  // namespace

SpanBasis span_basis(FloatRows rows, double tolerance, Index max_directions) {
  const Index count = rows.rows(), size = rows.cols();
  const auto length = static_cast<std::size_t>(size);
  const double enough = tolerance * tolerance;
  const Index at_a_time = std::max<Index>(kNumbersAtATime / std::max<Index>(size, 1), 1);
  std::vector<double> left(static_cast<std::size_t>(count));
  parallel_for_each(count, at_a_time, [&](Index n) {
    left[static_cast<std::size_t>(n)] =
        fixed_order_dot(rows.row(n).data(), rows.row(n).data(), length);
  });
  std::vector<Eigen::VectorXf> directions, coordinates;
  while (static_cast<Index>(directions.size()) < max_directions) {
    const auto longest = std::max_element(left.begin(), left.end());
    if (longest == left.end() || *longest <= enough || *longest == 0) break;
    const auto pivot = static_cast<Index>(longest - left.begin());
    Eigen::VectorXf& q = directions.emplace_back(size);
    const auto scale = static_cast<float>(1 / std::sqrt(*longest));
    for (Index i = 0; i < size; ++i) q[i] = rows(pivot, i) * scale;
    // Subtract from each row's remainder the component along the new direction.
    Eigen::VectorXf& along = coordinates.emplace_back(Eigen::VectorXf::Zero(count));
    parallel_for_each(count, at_a_time, [&](Index n) {
      double& rest = left[static_cast<std::size_t>(n)];
      if (rest <= enough) return;  // the directions span all rows well enough
      float* row = rows.row(n).data();
      const auto part = static_cast<float>(fixed_order_dot(q.data(), row, length));
      along[n] = part;
      rest = add_scaled_and_sum_squares(-part, q.data(), length, row);
      if (n == pivot) rest = 0;
    });
  }
  SpanBasis basis;
  const auto rank = static_cast<Index>(directions.size());
  basis.directions.resize(rank, size);
  basis.coordinates.resize(count, rank);
  for (Index p = 0; p < rank; ++p) {
    basis.directions.row(p) = directions[static_cast<std::size_t>(p)].transpose();
    basis.coordinates.col(p) = coordinates[static_cast<std::size_t>(p)];
  }
  return basis;
}

SpanBasis principal_basis(const SpanBasis& basis, double tolerance) {
  const Index count = basis.coordinates.rows(), size = basis.coordinates.cols();
  const Eigen::MatrixXd coordinates = basis.coordinates.cast<double>();
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(size, size);
  for (Index i = 0; i < size; ++i) {
    for (Index j = 0; j <= i; ++j) {
      double sum = 0;
      for (Index n = 0; n < count; ++n) sum += coordinates(n, i) * coordinates(n, j);
      products(i, j) = products(j, i) = sum;
    }
  }
  const Eigen::MatrixXd axes = eigenvectors_of_symmetric(std::move(products));
  Eigen::MatrixXd turned = Eigen::MatrixXd::Zero(count, size);
  for (Index p = 0; p < size; ++p) {
    for (Index i = 0; i < size; ++i) {
      for (Index n = 0; n < count; ++n) turned(n, p) += axes(i, p) * coordinates(n, i);
    }
  }
  Index rank = size;
  Eigen::VectorXd squared_rest = Eigen::VectorXd::Zero(count);
  for (; rank > 0; --rank) {
    for (Index n = 0; n < count; ++n) squared_rest[n] += turned(n, rank - 1) * turned(n, rank - 1);
    if (count > 0 && squared_rest.maxCoeff() > tolerance * tolerance) break;
  }
  SpanBasis result;
  result.coordinates = turned.leftCols(rank).cast<float>();
  result.directions = FloatRows::Zero(rank, basis.directions.cols());
  for (Index p = 0; p < rank; ++p) {
    for (Index i = 0; i < size; ++i) {
      const auto factor = static_cast<float>(axes(i, p));
      for (Index s = 0; s < basis.directions.cols(); ++s)
        result.directions(p, s) += factor * basis.directions(i, s);
    }
  }
  return result;
}

}  // namespace crowdface
