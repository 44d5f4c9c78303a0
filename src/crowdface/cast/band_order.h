// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "crowdface/blend/recipe.h"

namespace crowdface {

/// Lowers the levels at which finer bands begin, so that no band begins at a higher level than the
/// coarser band before it. Needed if bands come from several recipes, or if a coarser one was
/// written by hand.
void keep_order(RegionRecipe& region);

/// Copies bands from one recipe to another and restores the order of levels: the copied bands stay,
/// and the others change.
///
/// \param parts  Bands to copy: region · #bands + band.
void take_over(std::span<const std::size_t> parts, const Recipe& from, Recipe& recipe);

}  // namespace crowdface
