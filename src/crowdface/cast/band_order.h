// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "crowdface/blend/recipe.h"

namespace crowdface {

/// Lets no band begin at a higher level than the one before it: bands that were put together from
/// several recipes, or whose coarser one was written by hand, may. The finer one gives way.
void keep_order(RegionRecipe& region);

/// Gives bands of one face to another, and keeps the order there: the others give way to those.
/// \param parts  region · #bands + band
void take_over(std::span<const std::size_t> parts, const Recipe& from, Recipe& recipe);

}  // namespace crowdface
