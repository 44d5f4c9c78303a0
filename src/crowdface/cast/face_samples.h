// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/core/units.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/mirror_map.h"
#include "crowdface/smooth/level_basis.h"

namespace crowdface {

/// Vertices at which faces are compared and judged without being built.
using FaceSamples = std::vector<std::uint32_t>;

/// Samples spread over the skin (the largest component): half of them by area over its front half,
/// where the face is; the others over all of it, by area and by vertices, so that lips and lids,
/// which are small but finely meshed, get their share.
/// \param mean   #V by 3, the mean head.
/// \param count  how many; fewer if the skin has fewer vertices.
FaceSamples choose_face_samples(const Topology& topology, const Components& components,
                                const Positions& mean, Axis front, Index count);

/// The samples and those on the other side of the head that are vertices, ascending.
FaceSamples with_partners(const FaceSamples& samples, const MirrorMap& mirror);
/// The samples, and after them all other vertices whose positions their mirror images are made of.
FaceSamples with_corners(FaceSamples samples, const MirrorMap& mirror);

/// Levels at which trajectories are kept: round(L_max·(j/63)²), each once.
std::vector<std::uint64_t> trajectory_levels(std::uint64_t max_level);

/// How a head's samples move under smoothing: row l holds S_{L_l} x − x at all samples, three
/// numbers each, for the levels of `trajectory_levels`.
using Trajectory = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The trajectory of one head, from what the filter says at the nodes.
Trajectory sample_trajectory(const ChebyshevFilter& filter, const LevelNodes& nodes,
                             const NodeFields& fields, const FaceSamples& samples);

/// A row of a trajectory and how much of it a level takes.
struct LevelTerm {
  Index row = 0;
  double factor = 0;
};

/// How any level is put together from the rows of a trajectory: between two stored levels linear in
/// √L, in which trajectories are nearly straight. This is the only place that knows how levels are
/// represented; all of casting goes through it.
/// \param levels  those of the rows, ascending.
std::vector<LevelTerm> level_terms(const std::vector<std::uint64_t>& levels, std::uint64_t level);

}  // namespace crowdface
