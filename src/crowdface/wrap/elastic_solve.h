// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <Eigen/SparseCore>

#include "crowdface/mesh/triangles.h"

namespace crowdface {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// The area of each vertex: a third of the area of the adjacent triangles, but at least a
/// thousandth of the mean of these values.
Eigen::VectorXd vertex_areas(const std::vector<Triangle>& triangles, const Positions& positions);

/// The cotangent Laplacian (Pinkall & Polthier 1993), #V by #V, not divided by areas. Weights of
/// obtuse triangles are clamped to a small positive value, so that the discrete maximum principle
/// holds. The rows of boundary vertices are computed like all
/// other rows.
SparseMatrix laplacian(const std::vector<Triangle>& triangles, const Positions& positions);

/// The symmetric matrix B, #V by #V, for which dᵀ B d is the bending energy ∫ s |Δd|² of a
/// displacement field d.
/// \param areas  #V
/// \param stiffness  the relative stiffness s at each vertex.
SparseMatrix bending_energy(const SparseMatrix& laplacian, const Eigen::VectorXd& areas,
                            const Eigen::VectorXd& stiffness);

/// Quadratic data terms (d − offset)ᵀ W (d − offset). Each term belongs to one vertex, whose
/// displacement is d, and has its own offset and its own 3 by 3 matrix W. A vertex may have several
/// terms.
struct DataTerms {
  /// For each vertex: the sum of the matrices W of its terms; symmetric, positive semidefinite.
  std::vector<Eigen::Matrix3d> matrices;
  /// #V by 3. For each vertex: the sum of W · offset over its terms.
  Positions right_hand_side;

  /// Creates terms that are zero, for this number of vertices.
  explicit DataTerms(Index vertices)
      : matrices(static_cast<std::size_t>(vertices), Eigen::Matrix3d::Zero()),
        right_hand_side(Positions::Zero(vertices, 3)) {}
  /// Adds normal_weight · (n · (d − offset))² + isotropic_weight · |d − offset|², where d is the
  /// displacement and n is `normal`.
  void add(std::uint32_t vertex, const Eigen::Vector3d& normal, double normal_weight,
           double isotropic_weight, const Eigen::Vector3d& offset);
};

/// Finds displacements d that minimise the data terms plus dᵀ B d, summed over the three
/// coordinates. B is the stiffness matrix. Uses conjugate gradients, preconditioned with one
/// factorisation of B plus a typical weight per vertex (Eigen's SimplicialLDLT). The factorisation
/// serves all three coordinates and any number of solves.
class ElasticSolver {
 public:
  /// \param stiffness  #V by #V, symmetric, positive semidefinite
  /// \param typical_weights  #V positive weights, of the order of magnitude of the data terms
  ElasticSolver(const SparseMatrix& stiffness, const Eigen::VectorXd& typical_weights);
  ~ElasticSolver();

  /// When the conjugate gradients stop: after `max_steps` steps or at the `tolerance`.
  struct Limits {
    int max_steps = 60;
    /// Size of the residual relative to the right-hand side, both measured with the preconditioner.
    double tolerance = 1e-3;
  };
  /// Starts from `displacements`, #V by 3, and replaces them by an improved solution. The result is
  /// bitwise identical for any number of threads.
  void solve(const DataTerms& data_terms, const Limits& limits, Positions& displacements) const;

 private:
  struct State;  ///< the stiffness matrix and the factorisation
  std::unique_ptr<State> state_;
};

}  // namespace crowdface
