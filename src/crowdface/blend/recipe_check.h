// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/blend/recipe.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/region/region_weights.h"

namespace crowdface {

/// Checks that a recipe fits the heads and regions.
/// \throws BrokenPrecondition if the recipe names a head that does not exist, if a band begins at a
///         higher level than the coarser band before it, or if the regions do not match the
///         recipe's regions or the topology's vertices.
void require_recipe_fits(const HeadSet& heads, const RegionWeights& regions, const Recipe& recipe);

}  // namespace crowdface
