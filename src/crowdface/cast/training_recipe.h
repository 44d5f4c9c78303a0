// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "crowdface/blend/recipe.h"
#include "crowdface/cast/sampled_heads.h"

namespace crowdface {

/// A face as casting might make one, from all that heads and levels have, so that the main directions of a
/// face space know every way in which faces differ. Mirrored, and more or less asymmetric, where the heads
/// have mirror images.
/// \param bands  of each region's detail
/// \param index  each makes another face, always the same
Recipe training_recipe(const SampledHeads& heads, std::size_t bands, std::uint64_t index);

}  // namespace crowdface
