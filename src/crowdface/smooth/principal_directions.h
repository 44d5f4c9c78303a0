// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/smooth/level_nodes.h"

namespace crowdface {

/// The levels at which a basis is tested (129 evenly spaced in √L, each one's successor, so that
/// both parities are seen, and the nodes), and the weights of the nodes there.
struct TestedLevels {
  std::vector<std::uint64_t> levels;
  Eigen::MatrixXd weights;  ///< #levels by #nodes
};
TestedLevels test_levels(const LevelNodes& nodes);

/// Displacements of some vertices at the nodes: node n, coordinate c of vertex v is
/// values[(v·#nodes + n)·3 + c].
struct NodeDisplacements {
  Index nodes = 0;
  std::vector<double> values;
  Index vertices() const { return static_cast<Index>(values.size()) / (3 * nodes); }
};

/// Directions in the space of trajectories, most important first. All of them represent what the
/// nodes do; the first few most of it.
struct Directions {
  Eigen::MatrixXd mixing;     ///< #nodes by #nodes: φ_p(L) = Σ_n w_n(L) mixing(n, p)
  Eigen::MatrixXd combining;  ///< #nodes by #nodes: c_p = Σ_n combining(n, p) (S_{N_n} x − x)
  Eigen::MatrixXd functions;  ///< #levels by #nodes: φ_p at the tested levels
  Eigen::MatrixXd missed;     ///< #levels by #nodes + 1: the largest distance at the sample with
                              ///< 0, 1, … directions kept
  Index rank = 0;             ///< how many are enough for the tolerance at the sample
};

/// Principal components of the sample's trajectories over the tested levels (proper orthogonal
/// decomposition; Berkooz, Holmes & Lumley 1993), with the levels reweighted a few times by the
/// largest distance missed there (after Lawson 1961), because what counts is the largest distance
/// and not the mean.
/// \param tolerance  rank is the least found whose largest distance at the sample is below it, or
///                   #nodes.
Directions principal_directions(const TestedLevels& tested, const NodeDisplacements& sample,
                                double tolerance);

}  // namespace crowdface
