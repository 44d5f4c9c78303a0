// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "crowdface/blend/recipe.h"
#include "crowdface/cast/sampling.h"
#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// What turns a smoothness into iterations on this face set.
struct LevelScale {
  OperatorKind kind = OperatorKind::kUmbrella;
  std::uint64_t max_level = 1;  ///< L_max, what smoothness 1 stands for
  double edge_length_mm = 1;    ///< rms edge length of the skin, averaged over the face set
};

/// All that casting needs to know.
struct Casting {
  std::string name;         ///< the crowd's
  std::uint64_t count = 0;  ///< sampled faces
  std::uint64_t seed = 1;
  std::vector<PlanePoint> anchors;        ///< #heads
  std::vector<std::string> region_names;  ///< "all" if there are no regions
  SamplingOptions sampling;
  std::vector<HandRecipe> recipes;
  Normalization normalization = Normalization::kPartition;
  LevelScale scale;
};

/// Whole iterations of a smoothness: the nearest to smoothness·L_max.
std::uint64_t iterations_of(double smoothness, const LevelScale& scale);

/// The id of sampled face `index`: the crowd's name and at least four digits.
std::string face_id(const std::string& crowd, std::uint64_t index);

/// The recipe of sampled face `index` (from 1): a pure function of the arguments, so that it is the
/// same whatever the count or the order.
Recipe cast_face(const Casting& casting, std::uint64_t index);

/// Hand-written recipes in their order, then faces 1 … count.
/// \throws InvalidInput if a hand-written recipe's weights cannot be normalised.
std::vector<Recipe> cast_crowd(const Casting& casting);

}  // namespace crowdface
