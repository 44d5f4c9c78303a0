// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/smooth/level_nodes.h"

namespace crowdface {

/// The smoothing levels at which a basis is tested, and the interpolation weights of the nodes of
/// LevelNodes at these levels. The tested levels are: 129 levels evenly spaced in √level, the
/// successor of each of these levels (so that even and odd levels occur), and the levels of the
/// nodes.
struct TestedLevels {
  std::vector<std::uint64_t> levels;  ///< the tested levels, ascending
  /// #levels by #nodes: LevelNodes::interpolation_weights of each tested level
  Eigen::MatrixXd node_weights;
};
/// Makes the list of the tested levels for these nodes.
TestedLevels make_tested_levels(const LevelNodes& nodes);

/// Displacements of some vertices (the sample) at the levels of the nodes of LevelNodes. Coordinate
/// c of vertex number v of the sample at node n is displacements[(v·#nodes + n)·3 + c].
struct NodeDisplacements {
  Index node_count = 0;
  std::vector<double> displacements;  ///< the displacements in one list: #vertices by #nodes by 3
  Index vertex_count() const { return static_cast<Index>(displacements.size()) / (3 * node_count); }
};

/// Orthogonal directions in the space of vertex trajectories, most important first. A trajectory is
/// the displacement of a vertex as a function of the smoothing level (number of smoothing
/// iterations). All directions together reproduce the displacements at the levels of the nodes (see
/// LevelNodes) exactly; the first few directions reproduce them approximately.
struct PrincipalDirections {
  /// #nodes by #nodes: row n belongs to node n, column p to direction p. Column p gives the level
  /// function of direction p, by which the direction's vector field is multiplied at level L:
  /// φ_p(L) = Σ_n w_n(L) function_coefficients(n, p). Here, w_n(L) are the interpolation weights of
  /// LevelNodes.
  Eigen::MatrixXd function_coefficients;
  /// #nodes by #nodes: column p gives the vector field of direction p,
  /// c_p = Σ_n field_coefficients(n, p) d_n. Here, d_n are the displacements of all vertices at the
  /// smoothing level of node n.
  Eigen::MatrixXd field_coefficients;
  Eigen::MatrixXd level_functions;  ///< #levels by #nodes: φ_p at the tested levels
  /// #levels by (#nodes + 1): entry (l, r) is the largest error of any sampled vertex at the tested
  /// level l if only the first r directions are used
  Eigen::MatrixXd max_errors;
  Index rank = 0;  ///< smallest number of leading directions that together meet the tolerance
};

/// Principal components of the sample's trajectories over the tested levels (proper orthogonal
/// decomposition; Berkooz, Holmes & Lumley 1993). A few rounds reweight the levels by their largest
/// error (after Lawson 1961), which reduces the maximum error instead of the mean error.
/// \param tolerance  largest allowed error at the sampled vertices. The result has the lowest rank
///                   found whose error is within the tolerance; if there is none, the rank is
///                   #nodes.
PrincipalDirections principal_directions(const TestedLevels& tested,
                                         const NodeDisplacements& sample, double tolerance);

}  // namespace crowdface
