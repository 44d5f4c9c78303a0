// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace crowdface {

/// Eigenvalues, largest first, and the corresponding eigenvectors as columns.
struct SymmetricEigen {
  Eigen::VectorXd eigenvalues;   ///< the eigenvalues, largest first
  Eigen::MatrixXd eigenvectors;  ///< the eigenvectors: column i belongs to eigenvalue i
};

/// Eigendecomposition of a small symmetric matrix by Jacobi rotations (Golub & Van Loan 2013,
/// §8.5). Slower than a library routine, but the result is bit-identical on every machine. The bits
/// of generated meshes and plans depend on this result.
SymmetricEigen symmetric_eigen(Eigen::MatrixXd matrix);

}  // namespace crowdface
