// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "crowdface/mesh/triangles.h"

namespace crowdface {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// The area of each vertex, #V: a third of the triangles around, not below a thousandth of the mean.
Eigen::VectorXd vertex_areas(const std::vector<Triangle>& triangles, const Positions& positions);

/// The Laplacian with cotangent weights (Pinkall & Polthier 1993), #V by #V, not divided by areas;
/// weights of blunt triangles are kept from falling below a small positive one, so that the discrete
/// maximum principle holds. Rows of rims are there like all others: they let a rim be moved, not bent.
SparseMatrix laplacian(const std::vector<Triangle>& triangles, const Positions& positions);

/// ∫ s |Δd|² as dᵀ B d, #V by #V, symmetric: what it costs to bend a field of displacements.
/// \param areas    #V
/// \param factors  #V, s: how much stiffer than elsewhere.
SparseMatrix bending_energy(const SparseMatrix& laplacian, const Eigen::VectorXd& areas,
                            const Eigen::VectorXd& factors);

}  // namespace crowdface
