// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/blend/recipe.h"

namespace crowdface {

/// Lets no band begin at a higher level than the one before it: bands that were put together from
/// several recipes, or whose coarser one was written by hand, may.
void keep_order(RegionRecipe& region);

}  // namespace crowdface
