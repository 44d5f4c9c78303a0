// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "crowdface/blend/recipe.h"

namespace crowdface {

/// Lowers the smoothing levels at which finer bands begin, so that no band begins at a higher level
/// than the next coarser band. This can be necessary if the bands come from several recipes, or if
/// a user wrote a coarser band by hand.
void keep_order(RegionRecipe& region);

/// Copies bands from one recipe to another. Then restores the order of levels by changing only
/// bands that were not copied.
///
/// \param parts  Bands to copy: region · #bands + band.
void take_over(std::span<const std::size_t> parts, const Recipe& from, Recipe& recipe);

/// Copies bands as take_over does, and the target, mirroring and asymmetry, which the bands require.
void keep_locked(std::span<const std::size_t> parts, const Recipe& from, Recipe& recipe);

}  // namespace crowdface
