// SPDX-License-Identifier: Apache-2.0
// Sums in one order, so that their bits are the same with every compiler and instruction set: the
// order of a library's products follows the machine it is compiled for.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace crowdface {

/// Σ a_i b_i, ascending. \param b  at least as long as a.
inline double fixed_dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// to − factor·from, in place.
inline void subtract_scaled(double factor, std::span<const double> from, std::span<double> to) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] -= factor * from[i];
}

/// Takes out of a vector what lies along orthonormal ones and makes it of unit length (Gram and
/// Schmidt, twice for rounding).
/// \param count      of the orthonormal vectors.
/// \param direction  direction(m): number m of them, as long as the vector.
/// \param share      share(m, part): called with what was taken out along it, twice.
/// \return           the length of what was left.
template <class Direction, class Share>
double orthonormalize(std::span<double> vector, std::size_t count, const Direction& direction,
                      const Share& share) {
  for (int twice = 0; twice < 2; ++twice) {
    for (std::size_t m = 0; m < count; ++m) {
      const double part = fixed_dot(vector, direction(m));
      share(m, part);
      subtract_scaled(part, direction(m), vector);
    }
  }
  const double length = std::sqrt(fixed_dot(vector, vector));
  for (double& value : vector) value /= length;
  return length;
}

/// Lower L with L Lᵀ = a, for the first n rows of a positive definite matrix (Cholesky); what stands
/// above the diagonal is neither read nor written.
/// \tparam Matrix  rows of contiguous doubles.
template <class Matrix>
Matrix cholesky(Matrix a, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double rest = a[i][j] - fixed_dot({a[i].data(), j}, {a[j].data(), j});
      a[i][j] = i == j ? std::sqrt(rest) : rest / a[j][j];
    }
  }
  return a;
}

/// L⁻¹ b, for the first n rows.
template <class Matrix, class Vector>
Vector solve_lower(const Matrix& lower, Vector b, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    b[i] = (b[i] - fixed_dot({lower[i].data(), i}, {b.data(), i})) / lower[i][i];
  }
  return b;
}

}  // namespace crowdface
