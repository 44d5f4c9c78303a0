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

/// What faces are made of, at the samples: enough to tell where any recipe's samples lie.
struct SampledHeads {
  std::vector<Positions> heads;  ///< #S by 3 each, in millimetres
  Positions mean;                ///< #S by 3
  Columns alpha;                 ///< #S by #regions
  std::span<const Trajectory> trajectories;
  /// For each region the stretches of samples that it acts on, [begin, end): regions are patches,
  /// and samples stand along a curve, so they are few.
  std::vector<std::vector<std::pair<Index, Index>>> stretches;
  std::vector<std::uint64_t> levels;  ///< of the trajectories' rows
  double mm_per_unit = 1;             ///< of the trajectories
  std::vector<Trajectory> own;        ///< the trajectories, if nobody else holds them
  /// The heads' mirror images at the same samples, by which faces are mirrored; none: no face is.
  std::shared_ptr<const SampledHeads> image;
};

SampledHeads sample_heads(const FaceSet& faces, const RegionWeights& regions,
                          const FaceSamples& samples, std::span<const Trajectory> trajectories,
                          std::uint64_t max_level, double mm_per_unit);

/// What mirror images of faces are made of. Where the other side of a sample is no vertex, masks and
/// trajectories are each taken there.
/// \param heads   of the same samples
/// \param traced  whose trajectories those of `heads` are: the samples and their with_corners
std::shared_ptr<const SampledHeads> sample_images(
    const FaceSet& faces, const RegionWeights& regions, const MirrorMap& mirror,
    const FaceSamples& samples, const FaceSamples& traced, const SampledHeads& heads);

/// The samples of a recipe's target, #S by 3 in millimetres, mirrored as the face is.
Positions sample_target(const SampledHeads& heads, const Recipe& recipe);

/// The samples of a recipe's face, #S by 3 in millimetres, not aligned (Eq. 7).
/// \throws BrokenPrecondition if it is mirrored, or its asymmetry is not 1, and there are no images.
Positions sample_face(const SampledHeads& heads, const Recipe& recipe);

}  // namespace crowdface
