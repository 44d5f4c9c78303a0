// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "crowdface/blend/recipe.h"

namespace crowdface {

/// Lowers the smoothing levels at which finer bands begin, so that no band begins at a higher level
/// than the next coarser band. The order of the levels can be wrong if the bands come from several
/// recipes, or if a user wrote a coarser band by hand.
void restore_level_order(RegionRecipe& region);

/// Copies bands from one recipe to another. Then restores the order of the bands' levels (see
/// restore_level_order) by changing only bands that were not copied.
///
/// \param band_indices  Bands to copy. One number i stands for one band of one region: i = r · B +
///                      b, where r is the index of the region, B is the number of bands of each
///                      region, and b is the index of the band in the region.
void copy_bands(std::span<const std::size_t> band_indices, const Recipe& from, Recipe& recipe);

/// Like copy_bands, but also copies the target, the mirroring and the asymmetry, because the shape
/// of the bands depends on these values.
void copy_locked_bands(std::span<const std::size_t> band_indices, const Recipe& from,
                       Recipe& recipe);

}  // namespace crowdface
