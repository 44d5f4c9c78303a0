// SPDX-License-Identifier: Apache-2.0
// Linear algebra that adds terms in a fixed order, so that results are the same bit for bit with
// every compiler and instruction set. Linear algebra libraries do not ensure this, because the
// order of their sums depends on the machine.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace crowdface {

/// Σ a_i b_i, summed in ascending order of i. \param b  at least as long as a.
inline double fixed_order_dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Subtracts in place: y ← y − factor·x.
inline void subtract_scaled(double factor, std::span<const double> x, std::span<double> y) {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] -= factor * x[i];
}

/// Subtracts from `vector` its components along orthonormal directions and scales it to unit length
/// (Gram–Schmidt, two passes against rounding errors).
/// \param count       number of orthonormal directions.
/// \param direction   direction(m) returns direction m, a span of the size of `vector`.
/// \param on_removal  in each of the two passes, on_removal(m, component) is called for each
///                    direction m; `component` is the component that the pass removes.
/// \return            Euclidean norm of `vector` after the subtraction and before the scaling.
template <class Direction, class OnRemoval>
double orthonormalize(std::span<double> vector, std::size_t count, const Direction& direction,
                      const OnRemoval& on_removal) {
  for (int twice = 0; twice < 2; ++twice) {
    for (std::size_t m = 0; m < count; ++m) {
      const double component = fixed_order_dot(vector, direction(m));
      on_removal(m, component);
      subtract_scaled(component, direction(m), vector);
    }
  }
  const double length = std::sqrt(fixed_order_dot(vector, vector));
  for (double& value : vector) value /= length;
  return length;
}

/// Cholesky factor: lower triangular L with L Lᵀ = a, for the leading n by n block of a positive
/// definite matrix. Entries above the diagonal are neither read nor changed.
/// \tparam Matrix  such that a[i].data() points to row i, which is stored contiguously.
template <class Matrix>
Matrix cholesky(Matrix a, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double remaining = a[i][j] - fixed_order_dot({a[i].data(), j}, {a[j].data(), j});
      a[i][j] = i == j ? std::sqrt(remaining) : remaining / a[j][j];
    }
  }
  return a;
}

/// Solves L x = b by forward substitution, for the first n rows.
template <class Matrix, class Vector>
Vector solve_lower(const Matrix& lower, Vector b, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    b[i] = (b[i] - fixed_order_dot({lower[i].data(), i}, {b.data(), i})) / lower[i][i];
  }
  return b;
}

}  // namespace crowdface
