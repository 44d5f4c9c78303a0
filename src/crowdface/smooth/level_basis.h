// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/smooth/chebyshev_filter.h"
#include "crowdface/smooth/level_fields.h"
#include "crowdface/smooth/level_nodes.h"

namespace crowdface {

/// The error of a basis: distances between smoothed vertex positions from the basis and from the
/// exact filter, in the unit of the positions.
struct BasisError {
  /// Upper bound for the distance at any vertex and any tested level. It is the sum of two errors.
  /// The first is the largest error, at any vertex, from keeping only a few vector fields. The
  /// second is the largest error of the interpolation between the nodes of LevelNodes; it is
  /// measured only at a few vertices (the probes).
  double max = 0;
  double rms = 0;  ///< root mean square of the distances, over the probes and the tested levels
  std::uint64_t level = 0;  ///< the level at which `max` occurs
};

/// Represents all levels of one head by a few vector fields c_p: S_L x ≈ x + Σ_p φ_p(L) c_p(x).
/// Level L is the head after L smoothing iterations; level 0 is the head itself.
struct LevelBasis {
  std::uint64_t max_level = 1;  ///< L_max, the highest level that the basis represents
  /// #nodes by rank: row n belongs to node n of LevelNodes, column p to the vector field c_p.
  /// Column p gives the level function by which c_p is multiplied at level L:
  /// φ_p(L) = Σ_n w_n(L) function_coefficients(n, p). Here, w_n(L) are the interpolation weights of
  /// LevelNodes.
  Eigen::MatrixXd function_coefficients;
  /// the vector fields c_p (p = 0 … rank() − 1), each with a vector at each vertex of the mesh
  LevelFields fields;
  BasisError error;  ///< measured distances between this basis and the exact filter

  /// Number of vector fields of the basis.
  Index rank() const { return function_coefficients.cols(); }
};

/// Returns the level functions φ_p(L) of a LevelBasis for all p.
/// \param coefficients  see LevelBasis::function_coefficients.
std::vector<double> level_function_values(const LevelNodes& nodes,
                                          const Eigen::MatrixXd& coefficients, std::uint64_t level);

/// One head filtered to the levels of all nodes (LevelNodes); the result of filter_nodes.
struct NodeFields {
  /// For each node n with its level N_n: the displacements S_{N_n} x − x of all vertices by N_n
  /// smoothing iterations, in the filter's row order.
  std::vector<RowArray<float>> displacements;
  /// Chebyshev terms at a few vertices (the probes). The terms give the exact displacements of the
  /// probes at every level. fit_level_basis measures the error of a basis against these
  /// displacements.
  RecordedTerms probe_terms;
};

/// Smooths one head to the levels of all nodes in one pass of the filter, in single precision.
NodeFields filter_nodes(const ChebyshevFilter& filter, const LevelNodes& nodes,
                        const Positions& positions);

/// Fits a basis to one head. The fields are the principal directions of the head's own
/// displacements (principal_directions). Each tile of vertices keeps the fewest leading fields
/// whose truncation error is below tolerance/8 and whose total error is below the tolerance. The
/// reported error is measured, not estimated: the sum of the largest truncation error at any vertex
/// and any tested level, the error of the interpolation between nodes (measured against the exact
/// filter at the probes), and the largest rounding error of the 16-bit values.
/// \param fields     result of filter_nodes for this head.
/// \param tolerance  in the unit of the positions, > 0.
/// \throws InvalidInput if no number of fields reaches the tolerance; the message states the error
///     that was reached.
LevelBasis fit_level_basis(const ChebyshevFilter& filter, const LevelNodes& nodes,
                           const NodeFields& fields, double tolerance);

}  // namespace crowdface
