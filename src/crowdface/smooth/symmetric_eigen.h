// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace crowdface {

/// Eigenvalues, largest first, and the eigenvectors that go with them, as columns.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Of a small symmetric matrix, by Jacobi's rotations (Golub & Van Loan 2013, §8.5): slower than a
/// library's, but with the same bits on every machine, since what a mesh is made of hangs on them.
SymmetricEigen symmetric_eigen(Eigen::MatrixXd matrix);

}  // namespace crowdface
