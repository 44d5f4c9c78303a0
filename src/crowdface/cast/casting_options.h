// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/blend/recipe.h"
#include "crowdface/cast/diversity.h"
#include "crowdface/cast/family.h"
#include "crowdface/cast/review.h"
#include "crowdface/cast/sampling.h"
#include "crowdface/cast/typical_head.h"
#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// Converts a smoothness (0 … 1) to a number of smoothing iterations.
struct SmoothingLevelScale {
  OperatorKind operator_kind = OperatorKind::kUmbrella;
  std::uint64_t max_level = 1;  ///< L_max: number of iterations at smoothness 1
  /// root mean square edge length of the skin, averaged over the heads
  double edge_length_mm = 1;
};

/// All inputs of casting except the face space.
struct CastingOptions {
  std::string name;                 ///< name of the crowd
  std::uint64_t count = 0;          ///< number of sampled faces
  std::uint64_t seed = 1;           ///< seed of the crowd's random numbers
  std::vector<PlanePoint> anchors;  ///< position of each head on the weight plane
  /// names of the regions; contains only "all" if the config has no regions
  std::vector<std::string> region_names;
  SamplingOptions sampling;
  std::vector<ManualRecipe> recipes;
  Normalization normalization = Normalization::kPartition;
  SmoothingLevelScale level_scale;
  DiversityOptions diversity = {};
  std::vector<FamilyOptions> families = {};
  std::vector<Review> reviews = {};  ///< reviews, which are applied one after the other
  std::vector<Group> groups = {};    ///< groups of the sampled faces
  HeadTags tags = {};                ///< the tags of each head; or empty
  /// distributions that the measurements of the crowd should have
  std::vector<TraitTarget> trait_targets = {};
  std::vector<FaceChange> changes = {};      ///< changes of single faces that the config requests
  std::vector<double> head_ages_years = {};  ///< the age of each head; or empty
};

/// Returns the sampling parameters of a group's faces. If `group` is empty, returns the parameters
/// of the faces that have no group.
const SamplingOptions& sampling_of(const CastingOptions& casting,
                                   const std::optional<std::string>& group);

}  // namespace crowdface
