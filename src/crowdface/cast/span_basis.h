// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace crowdface {

using FloatRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// An orthonormal basis of the span of given rows, and the rows' coordinates in this basis.
struct SpanBasis {
  FloatRows directions;   ///< #P by #S
  FloatRows coordinates;  ///< #N by #P: row n is approximately Σ_p coordinates(n, p) directions(p)
};

/// Finds a basis that spans all rows: the row with the longest remainder gives the next direction
/// (Gram–Schmidt with pivoting, Businger & Golub 1965), until every remainder is at most
/// `tolerance` long or there are `most` directions. Plain loops, so the bits are the same
/// everywhere.
SpanBasis span_basis(FloatRows rows, double tolerance, Eigen::Index most);

}  // namespace crowdface
