// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/span_basis.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "crowdface/cast/float_kernels.h"
#include "crowdface/core/parallel.h"
#include "crowdface/smooth/symmetric_eigen.h"

namespace crowdface {
namespace {

using Eigen::Index;

constexpr Index kNumbersAtATime = 1 << 16;

}  // namespace

FloatRows fixed_order_product(const FloatRows& a, const FloatRows& b) {
  FloatRows result = FloatRows::Zero(a.rows(), b.cols());
  add_product(a.data(), static_cast<std::size_t>(a.rows()), static_cast<std::size_t>(a.cols()),
              b.data(), static_cast<std::size_t>(b.cols()), result.data());
  return result;
}

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
  if (size == 0) return basis;
  const FloatRows columns = basis.coordinates.transpose();
  Eigen::MatrixXd products(size, size);
  for (Index i = 0; i < size; ++i) {
    for (Index j = 0; j <= i; ++j) {
      products(i, j) = products(j, i) = fixed_order_dot(
          columns.row(i).data(), columns.row(j).data(), static_cast<std::size_t>(count));
    }
  }
  const FloatRows axes = symmetric_eigen(std::move(products)).eigenvectors.cast<float>();
  FloatRows coordinates = fixed_order_product(basis.coordinates, axes);
  Index kept = size;
  Eigen::VectorXd squared_remainders = Eigen::VectorXd::Zero(count);
  for (; kept > 0; --kept) {
    for (Index n = 0; n < count; ++n) {
      const auto last = static_cast<double>(coordinates(n, kept - 1));
      squared_remainders[n] += last * last;
    }
    if (squared_remainders.maxCoeff() > tolerance * tolerance) break;
  }
  return {fixed_order_product(axes.leftCols(kept).transpose(), basis.directions),
          coordinates.leftCols(kept)};
}

}  // namespace crowdface
