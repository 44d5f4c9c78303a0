// SPDX-License-Identifier: Apache-2.0
#pragma once

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
};

SampledHeads sample_heads(const FaceSet& faces, const RegionWeights& regions,
                          const FaceSamples& samples, std::span<const Trajectory> trajectories,
                          std::uint64_t max_level, double mm_per_unit);

/// Which of the two faces a recipe stands for when distances are measured.
enum class Variant {
  kAsBuilt,
  kUnit,  ///< every extrapolation factor set to 1
};
Extrapolation extrapolation_of(Variant variant);

/// The samples of a recipe's target, #S by 3 in millimetres.
Positions sample_target(const SampledHeads& heads, const Recipe& recipe);

/// The samples of a recipe's face, #S by 3 in millimetres, not aligned (Eq. 7).
Positions sample_face(const SampledHeads& heads, const Recipe& recipe, Variant variant);

}  // namespace crowdface
