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

/// The data of the heads at the samples. They determine the samples of any recipe's face.
struct SampledHeads {
  std::vector<Positions> heads;  ///< #S by 3 each, in millimetres
  Positions mean;                ///< #S by 3
  Columns region_weights;        ///< #S by #regions
  std::span<const Trajectory> trajectories;
  /// For each region, the ranges of samples [begin, end) with nonzero weight. Regions are patches,
  /// and samples are ordered along a curve, so there are few ranges.
  std::vector<std::vector<std::pair<Index, Index>>> sample_ranges;
  std::vector<std::uint64_t> levels;  ///< levels of the trajectories' rows
  double mm_per_unit = 1;             ///< scale of the trajectories
  std::vector<Trajectory>
      owned_trajectories;  ///< storage of the trajectories, if this object owns them
  /// The heads' mirror images at the same samples, used to mirror faces; null: no face is mirrored.
  std::shared_ptr<const SampledHeads> mirror_images;
};

/// Returns the data of the heads at the samples, without mirror images.
SampledHeads sample_heads(const HeadSet& head_set, const RegionWeights& regions,
                          const FaceSamples& samples, std::span<const Trajectory> trajectories,
                          std::uint64_t max_level, double mm_per_unit);

/// Computes the mirror images of the heads. If a sample's partner is not a vertex, its weights and
/// trajectories are interpolated.
///
/// \param heads   Heads at the same samples.
/// \param traced  Vertices of the trajectories of `heads`: samples_and_mirror_corners of the
///                samples.
std::shared_ptr<const SampledHeads> sample_mirror_images(
    const HeadSet& head_set, const RegionWeights& regions, const MirrorMap& mirror,
    const FaceSamples& samples, const FaceSamples& traced, const SampledHeads& heads);

/// Returns the samples of a recipe's target, #S by 3 in millimetres, mirrored like the face.
Positions sample_target(const SampledHeads& heads, const Recipe& recipe);

/// Returns the samples of a recipe's face, #S by 3 in millimetres, not aligned (Eq. 7).
///
/// \throws BrokenPrecondition if the face is mirrored or its asymmetry is not 1, and there are no
/// mirror images.
Positions sample_face(const SampledHeads& heads, const Recipe& recipe);

}  // namespace crowdface
