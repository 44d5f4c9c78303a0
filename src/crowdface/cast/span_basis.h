// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace crowdface {

using FloatRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Orthonormal directions and what the rows they were made from are in them.
struct SpanBasis {
  FloatRows directions;   ///< #P by #S
  FloatRows coordinates;  ///< #N by #P: row n is Σ_p coordinates(n, p) directions(p), nearly
};

/// Directions that span all rows: again and again the row that is least well spanned gives the next
/// one (Gram–Schmidt with pivoting, Businger & Golub 1965), until what is left of every row is at
/// most `tolerance` long, or there are `most` directions. In plain loops, so that the bits are the
/// same everywhere.
SpanBasis span_basis(FloatRows rows, double tolerance, Eigen::Index most);

}  // namespace crowdface
