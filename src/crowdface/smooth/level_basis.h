// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/smooth/chebyshev_filter.h"
#include "crowdface/smooth/level_fields.h"
#include "crowdface/smooth/level_nodes.h"

namespace crowdface {

/// How far a basis is from the exact filter, in the positions' unit.
struct BasisError {
  double max = 0;           ///< over all vertices and tested levels
  double rms = 0;           ///< over the probes and tested levels
  std::uint64_t level = 0;  ///< where the maximum is
};

/// All levels of one head in a few fields: S_L x ≈ x + Σ_p φ_p(L) c_p(x). Level 0 is the head
/// itself.
struct LevelBasis {
  std::uint64_t max_level = 1;
  Eigen::MatrixXd mixing;  ///< #nodes by rank: φ_p(L) = Σ_n w_n(L) mixing(n, p)
  LevelFields fields;      ///< c_p
  BasisError error;

  Index rank() const { return mixing.cols(); }
};

/// φ_p(L) of a basis whose mixing this is.
std::vector<double> basis_functions(const LevelNodes& nodes, const Eigen::MatrixXd& mixing,
                                    std::uint64_t level);

/// What one pass of the filter says about a head.
struct NodeFields {
  std::vector<RowArray<float>> displacements;  ///< S_{N_n} x − x for each node, in the
                                               ///< filter's order of rows
  Probes probes;                               ///< the filter itself at some vertices
};

/// All levels of the nodes in one pass, in single precision.
NodeFields filter_nodes(const ChebyshevFilter& filter, const LevelNodes& nodes,
                        const Positions& positions);

/// Fits one head: finds the directions in which its own vertices move most (principal_directions),
/// and keeps of each tile of vertices as few as keep the error under the tolerance, and under an eighth of it what
/// is left out. The error is measured: what a tile leaves out at every vertex and every tested level, and on top of it what
/// the nodes leave out, at the probes against the filter itself, and what 16 bits may round away.
/// \param tolerance  in the positions' unit, > 0.
/// \throws InvalidInput if no number of fields reaches the tolerance: the message says what was reached.
LevelBasis fit_level_basis(const ChebyshevFilter& filter, const LevelNodes& nodes,
                           const NodeFields& fields, double tolerance);

}  // namespace crowdface
