// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/core/units.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/mirror_map.h"
#include "crowdface/smooth/level_basis.h"

namespace crowdface {

/// Indices of the vertices at which faces are compared and judged. The positions of these vertices
/// are enough, so no mesh needs to be built.
using FaceSamples = std::vector<std::uint32_t>;

/// Chooses samples on the skin (the largest component). Half of the samples are distributed by area
/// over the front half of the skin. A quarter are distributed by area over the whole skin, and a
/// quarter by the density of vertices. So lips and lids, which are small but finely meshed, get
/// enough samples. The result is ascending.
///
/// \param mean   #V by 3, the mean head.
/// \param count  Number of samples. If the skin has too few vertices, the result has fewer samples.
FaceSamples choose_face_samples(const Topology& topology, const Components& components,
                                const Positions& mean, Axis front, Index count);

/// Returns the samples, and every vertex that is exactly the mirror image of a sample; ascending.
FaceSamples samples_and_mirror_images(const FaceSamples& samples, const MirrorMap& mirror);
/// Returns the samples, followed by all other vertices that are needed to interpolate positions at
/// the samples' mirror images.
FaceSamples samples_and_mirror_corners(FaceSamples samples, const MirrorMap& mirror);

/// Returns the smoothing levels at which trajectories are stored: round(`max_level` · (j/63)²) for
/// j = 0, 1, …, 63, without duplicates.
std::vector<std::uint64_t> stored_smoothing_levels(std::uint64_t max_level);

/// How far smoothing displaces the samples of a head, #levels by 3·#samples. Row l holds S_L x − x:
/// the positions smoothed to level L (entry l of `stored_smoothing_levels`) minus the positions x.
using Trajectory = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Computes the trajectory of a head. Interpolates the displacements of the samples at all stored
/// smoothing levels from the displacements at a few levels, the nodes.
/// \param fields  result of filter_nodes for the head
Trajectory sample_smoothing_trajectory(const ChebyshevFilter& filter, const LevelNodes& nodes,
                                       const NodeFields& fields, const FaceSamples& samples);

/// A row of a trajectory (the displacements at one smoothing level), and the row's weight in an
/// interpolation between levels.
struct WeightedTrajectoryRow {
  Index row = 0;  ///< index of the row in the trajectory
  double weight = 0;
};

/// Returns the one or two rows of a trajectory whose weighted sum is the displacement at `level`.
/// Between stored levels, the interpolation is linear in √L, because trajectories are nearly
/// straight in √L. All of casting uses this function, so no other code knows how levels are stored.
///
/// \param levels  Levels of the rows, ascending.
std::vector<WeightedTrajectoryRow> interpolation_rows(const std::vector<std::uint64_t>& levels,
                                                      std::uint64_t level);

}  // namespace crowdface
