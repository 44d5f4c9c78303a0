// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace crowdface {

using FloatRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Returns a·b. Sums are computed in a fixed order, so the result is bit-identical everywhere.
FloatRows fixed_order_product(const FloatRows& a, const FloatRows& b);

/// An orthonormal basis of the linear span of the rows of a matrix, and the coordinates of these
/// rows in the basis. The matrix is #N by #S, and the basis has #P vectors.
struct SpanBasis {
  FloatRows directions;  ///< #P by #S: each of the P rows is one basis vector with S components
  /// #N by #P: row n of the matrix is approximately Σ_p coordinates(n, p) · (row p of `directions`)
  FloatRows coordinates;
};

/// Finds a basis that spans all rows. The row with the longest remainder (the part outside the
/// basis) gives the next direction (Gram–Schmidt with pivoting, Businger & Golub 1965), until every
/// remainder is at most `tolerance` long or there are `max_directions` directions. The code uses
/// plain loops, so that it computes the same bits everywhere.
SpanBasis span_basis(FloatRows rows, double tolerance, Eigen::Index max_directions);

/// Rotates the directions of a basis to the principal directions of its rows: the eigenvectors of
/// coordinatesᵀ·coordinates, the largest eigenvalue first. Leaves out the last directions as long
/// as this moves no row by more than `tolerance`.
SpanBasis principal_basis(const SpanBasis& basis, double tolerance);

}  // namespace crowdface
