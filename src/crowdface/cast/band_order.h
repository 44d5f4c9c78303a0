// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "crowdface/blend/recipe.h"

namespace crowdface {

/// Lowers the smoothing levels at which finer bands begin, so that no band begins at a higher level
/// than the next coarser band. This can be necessary if the bands come from several recipes, or if
/// a user wrote a coarser band by hand.
void restore_level_order(RegionRecipe& region);

/// Copies bands from one recipe to another. Then restores the order of levels by changing only
/// bands that were not copied.
///
/// \param parts  Bands to copy: region · #bands + band.
void copy_bands(std::span<const std::size_t> parts, const Recipe& from, Recipe& recipe);

/// Like copy_bands. Also copies the target, mirroring and asymmetry, on which the shape of the
/// bands depends.
void copy_locked_bands(std::span<const std::size_t> parts, const Recipe& from, Recipe& recipe);

}  // namespace crowdface
