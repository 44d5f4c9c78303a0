// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// A few levels from which all others follow: S_L x − x ≈ Σ_p w_p(L) (S_{N_p} x − x) for every x,
/// with nodes N_p and weights w_p that depend on the operator's spectrum and L_max alone. Each
/// eigenvector of the operator with eigenvalue λ is displaced by λ^L − 1; the nodes are chosen
/// greedily, and the weights by least squares, over a grid of λ in the operator's range (umbrella:
/// [−1, 1], so that the checkerboard near −1 counts and both parities are represented; lazy:
/// [0, 1]), dense towards ±1 and weighted by how much of a face's shape lies there (docs/method.md).
class LevelNodes {
 public:
  /// \param max_level  L_max, at least 1.
  /// \param missed     nodes are added until what they miss of any level is below this share of
  ///                   the displacement at L_max.
  LevelNodes(OperatorKind kind, std::uint64_t max_level, double missed = 2e-4);

  std::uint64_t max_level() const { return max_level_; }
  /// N_p, ascending, from 1 to L_max.
  const std::vector<std::uint64_t>& levels() const { return levels_; }

  /// w_p(L): exactly a unit vector at a node, exactly zero at L = 0.
  /// \throws BrokenPrecondition if level > max_level().
  std::vector<double> weights(std::uint64_t level) const;

 private:
  using Spectrum = std::vector<double>;  ///< a function of λ on the grid
  Spectrum displacement(std::uint64_t level) const;
  void choose_nodes(const std::vector<std::uint64_t>& candidates, double missed);

  std::uint64_t max_level_;
  std::vector<double> eigenvalues_, grid_weights_;
  std::vector<std::uint64_t> levels_;
  std::vector<Spectrum> directions_;           ///< orthonormal, in the order of choice
  std::vector<std::size_t> choice_;            ///< which of levels_ was chosen first, second, …
  std::vector<std::vector<double>> triangle_;  ///< node p = Σ_q triangle_[p][q] direction q
};

}  // namespace crowdface
