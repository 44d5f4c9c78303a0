// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/core/units.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/mirror_map.h"
#include "crowdface/smooth/level_basis.h"

namespace crowdface {

/// Vertices at which faces are compared and judged without building meshes.
using FaceSamples = std::vector<std::uint32_t>;

/// Chooses samples on the skin (the largest component): half by area over its front half, where the
/// face is, a quarter by area and a quarter by vertices over the whole skin. So lips and lids,
/// which are small but finely meshed, get enough samples.
///
/// \param mean   #V by 3, the mean head.
/// \param count  Number of samples. The skin may have too few vertices; then there are fewer
///               samples.
FaceSamples choose_face_samples(const Topology& topology, const Components& components,
                                const Positions& mean, Axis front, Index count);

/// Returns the samples and their mirror partners that are vertices, ascending.
FaceSamples with_partners(const FaceSamples& samples, const MirrorMap& mirror);
/// Returns the samples, followed by all other vertices that determine the positions of their mirror
/// images.
FaceSamples with_corners(FaceSamples samples, const MirrorMap& mirror);

/// Returns the levels at which trajectories are stored: round(L_max·(j/63)²), without duplicates.
std::vector<std::uint64_t> trajectory_levels(std::uint64_t max_level);

/// The displacements of a head's samples under smoothing, #levels by 3·#samples. Row l holds
/// S_{L_l} x − x for the l-th level of `trajectory_levels`.
using Trajectory = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Computes the trajectory of a head from the filter's displacements at the nodes.
Trajectory sample_trajectory(const ChebyshevFilter& filter, const LevelNodes& nodes,
                             const NodeFields& fields, const FaceSamples& samples);

/// A row of a trajectory, and its factor.
struct LevelTerm {
  Index row = 0;
  double factor = 0;
};

/// Returns the combination of trajectory rows for any level. Between stored levels the
/// interpolation is linear in √L, in which trajectories are nearly straight. This is the only
/// function that knows how levels are represented; all of casting uses it.
///
/// \param levels  Levels of the rows, ascending.
std::vector<LevelTerm> level_terms(const std::vector<std::uint64_t>& levels, std::uint64_t level);

}  // namespace crowdface
