// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "crowdface/blend/recipe.h"
#include "crowdface/cast/face_samples.h"
#include "crowdface/region/region_weights.h"

namespace crowdface {

/// The data of all heads at the sample vertices. These data suffice to compute, for any recipe, the
/// positions of the sample vertices on the recipe's face.
struct HeadsAtSamples {
  /// for each head, the positions of the samples, #S by 3, in millimetres
  std::vector<Positions> heads;
  Positions mean;          ///< the mean of `heads`, #S by 3, in millimetres
  Columns region_weights;  ///< #S by #regions: each region's weight at each sample
  /// for each head: how far smoothing displaces the samples, at all stored smoothing levels
  std::span<const Trajectory> trajectories;
  /// For each region, ranges [begin, end) that contain all samples with nonzero weight. Loops over
  /// a region's samples skip the other samples.
  std::vector<std::vector<std::pair<Index, Index>>> sample_ranges;
  /// for each row of every element of `trajectories`: the smoothing level of this row, as a number
  /// of iterations
  std::vector<std::uint64_t> levels;
  double mm_per_unit = 1;  ///< millimetres per unit of the trajectories
  /// storage of `trajectories` if this object owns them, otherwise empty
  std::vector<Trajectory> owned_trajectories;
  /// The heads' mirror images at the same samples, used to mirror faces; null: no face is mirrored.
  std::shared_ptr<const HeadsAtSamples> mirror_images;
};

/// Collects the data of the heads at the samples. Leaves HeadsAtSamples::mirror_images empty; see
/// sample_mirror_images.
///
/// \param max_level  largest smoothing level, in iterations, of the `trajectories`.
HeadsAtSamples sample_heads(const HeadSet& head_set, const RegionWeights& regions,
                            const FaceSamples& samples, std::span<const Trajectory> trajectories,
                            std::uint64_t max_level, double mm_per_unit);

/// Computes the mirror images of the heads at the same samples. If the mirror image of a sample is
/// not a vertex, the region weights and the trajectory at this point are interpolated between
/// vertices.
///
/// \param heads   The heads at the samples.
/// \param trajectory_vertices  The vertices whose displacements by smoothing `heads.trajectories`
///                stores: the result of samples_and_mirror_corners for `samples`.
std::shared_ptr<const HeadsAtSamples> sample_mirror_images(const HeadSet& head_set,
                                                           const RegionWeights& regions,
                                                           const MirrorMap& mirror,
                                                           const FaceSamples& samples,
                                                           const FaceSamples& trajectory_vertices,
                                                           const HeadsAtSamples& heads);

/// Returns the positions of the samples on a recipe's target (a head or a mixture of heads), #S by
/// 3 in millimetres. The target is mirrored if the recipe mirrors the face, and has the asymmetry
/// of the recipe.
Positions sample_target(const HeadsAtSamples& heads, const Recipe& recipe);

/// Returns the positions of the samples on a recipe's face, #S by 3 in millimetres (Eq. 7). The
/// face is not aligned to the mean head.
///
/// \throws BrokenPrecondition if the face is mirrored or its asymmetry is not 1, and there are no
/// mirror images.
Positions sample_face(const HeadsAtSamples& heads, const Recipe& recipe);

}  // namespace crowdface
