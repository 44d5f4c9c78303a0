// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/core/units.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/smooth/level_basis.h"

namespace crowdface {

/// Vertices at which faces are compared, ascending. Each stands for the same share of the face's
/// area, so that plain sums over them are integrals over the face.
using FaceSamples = std::vector<std::uint32_t>;

/// Samples spread evenly by area over the face: the skin (the largest component) in front of the
/// head's middle.
/// \param mean   #V by 3, the mean head.
/// \param count  how many; fewer if the face has fewer vertices.
FaceSamples choose_face_samples(const Topology& topology, const Components& components,
                                const Positions& mean, Axis front, Index count);

/// Levels at which trajectories are kept: round(L_max·(j/63)²), each once.
std::vector<std::uint64_t> trajectory_levels(std::uint64_t max_level);

/// How a head's samples move under smoothing: row l holds S_{L_l} x − x at all samples, three
/// numbers each, for the levels of `trajectory_levels`.
using Trajectory = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The trajectory of one head, from what the filter says at the nodes.
Trajectory sample_trajectory(const ChebyshevFilter& filter, const LevelNodes& nodes,
                             const NodeFields& fields, const FaceSamples& samples);

}  // namespace crowdface
