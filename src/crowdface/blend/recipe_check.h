// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/blend/recipe.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/region/region_weights.h"

namespace crowdface {

/// Checks that a recipe fits the heads and the regions.
///
/// \throws BrokenPrecondition if the recipe names a head that does not exist, if a band begins at a
/// higher level than the next coarser band, if `regions` and the recipe have different numbers of
/// regions, or if `regions` and the heads have different numbers of vertices.
void require_recipe_fits(const HeadSet& heads, const RegionWeights& regions, const Recipe& recipe);

}  // namespace crowdface
