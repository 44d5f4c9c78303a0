// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// S_L x are the positions x after L smoothing iterations; L is called the level, and L_max is the
/// highest level in use. This class chooses a few levels, the nodes N_p, from which all other
/// levels are interpolated:
///
///     S_L x − x ≈ Σ_p w_p(L) (S_{N_p} x − x)    for every x
///
/// The nodes and weights depend only on the operator kind and L_max, not on the mesh, for the
/// following reason: L iterations displace an eigenvector v of the smoothing operator, with
/// eigenvalue λ, by (λ^L − 1)·v. A greedy algorithm chooses the nodes. The weights w_p(L) are
/// computed by least squares over a grid of λ in the operator's spectrum. The spectrum is [−1, 1]
/// for the umbrella operator and [0, 1] for the lazy operator. Eigenvalues near −1 belong to
/// checkerboard modes, which make even and odd levels differ. The grid is dense towards ±1, and the
/// weight of each λ is the typical amplitude, in a head, of the modes with this eigenvalue
/// (docs/method.md).
class LevelNodes {
 public:
  /// \param max_level  L_max, at least 1.
  /// \param max_residual  largest allowed residual of any level, as a fraction of the displacement
  ///                      at L_max. The constructor adds nodes until no residual exceeds this
  ///                      limit.
  LevelNodes(OperatorKind kind, std::uint64_t max_level, double max_residual = 2e-4);

  /// L_max, the highest level that the nodes represent.
  std::uint64_t max_level() const { return max_level_; }
  /// The levels N_p of the nodes, ascending; all are in 1 … L_max.
  const std::vector<std::uint64_t>& levels() const { return levels_; }

  /// Returns the weight w_p(L) of each node p in the interpolation of the level L = `level`. If L
  /// is the level of a node, this node has exactly the weight 1 and all others have exactly 0. If
  /// L = 0, all weights are exactly 0.
  /// \throws BrokenPrecondition if level > max_level().
  std::vector<double> interpolation_weights(std::uint64_t level) const;

 private:
  using Spectrum = std::vector<double>;  ///< values of a function of λ at the grid points
  /// Returns the displacement after L = `level` smoothing iterations as a function of the
  /// eigenvalue λ of the smoothing operator: at each grid point (see eigenvalues_), (λ^L − 1) times
  /// the weight of the grid point.
  Spectrum displacement(std::uint64_t level) const;
  /// Adds nodes until no residual exceeds `max_residual`. Sets levels_, orthonormal_basis_,
  /// choice_order_ and triangular_factor_.
  /// \param candidates  the levels that may become nodes
  void choose_nodes(const std::vector<std::uint64_t>& candidates, double max_residual);

  std::uint64_t max_level_;  ///< L_max, the highest level
  /// The grid of eigenvalues of the smoothing operator, over which the least-squares fit runs: λ at
  /// each grid point, and the weight of the grid point.
  std::vector<double> eigenvalues_, grid_weights_;
  std::vector<std::uint64_t> levels_;  ///< the levels that are nodes, ascending
  /// Gram-Schmidt basis of the nodes' displacements. Element q belongs to the node that was chosen
  /// as number q. Element q is the component of this node's displacement that is orthogonal to
  /// elements 0 … q − 1, normalized.
  std::vector<Spectrum> orthonormal_basis_;
  /// indices into levels_, in the order in which choose_nodes chose the nodes
  std::vector<std::size_t> choice_order_;
  /// Row p belongs to node choice_order_[p]. The displacement after the iterations of this node's
  /// level is a linear combination of the basis: Σ_q triangular_factor_[p][q]
  /// orthonormal_basis_[q].
  std::vector<std::vector<double>> triangular_factor_;
};

}  // namespace crowdface
