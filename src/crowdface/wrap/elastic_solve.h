// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
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

/// What each vertex wants: Σ (d − offset)ᵀ W (d − offset) with a 3 by 3 matrix W a vertex.
struct Wishes {
  std::vector<Eigen::Matrix3d> matrices;  ///< #V: W, symmetric, positive or zero
  Positions right;                        ///< #V by 3: W · offset

  explicit Wishes(Index vertices)
      : matrices(static_cast<std::size_t>(vertices), Eigen::Matrix3d::Zero()),
        right(Positions::Zero(vertices, 3)) {}
  /// along · (n · (d − offset))² + all · |d − offset|²
  void add(std::uint32_t vertex, const Eigen::Vector3d& normal, double along, double all,
           const Eigen::Vector3d& offset);
};

/// Displacements d that minimise what the vertices want plus Σ over coordinates of dᵀ B d. By
/// conjugate gradients, preconditioned with one factorisation of B plus a typical weight a vertex
/// (Eigen's SimplicialLDLT), which serves all three coordinates and any number of solves.
class ElasticSolver {
 public:
  /// \param stiffness  #V by #V, symmetric, positive or zero
  /// \param typical    #V positive weights of about the sizes that wishes will have
  ElasticSolver(const SparseMatrix& stiffness, const Eigen::VectorXd& typical);
  ~ElasticSolver();

  struct Limits {
    int steps = 60;
    double tolerance = 1e-3;  ///< of the residual, against the right side's
  };
  /// Improves `displacements`, #V by 3. The same bits for any number of threads.
  void solve(const Wishes& wishes, const Limits& limits, Positions& displacements) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace crowdface
