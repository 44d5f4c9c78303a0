// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "crowdface/blend/recipe.h"
#include "crowdface/cast/heads_at_samples.h"

namespace crowdface {

/// Returns a random recipe like the recipes of casting, drawn from all heads and all levels.
/// FaceSpace computes its principal directions from the faces of these recipes (the training set),
/// so that the directions cover all differences between faces. If there are mirror images, faces
/// are mirrored and vary in asymmetry.
///
/// \param bands  Number of bands of detail in each region.
/// \param index  Number of the recipe; the same index always gives the same recipe.
Recipe random_training_recipe(const HeadsAtSamples& heads, std::size_t bands, std::uint64_t index);

}  // namespace crowdface
