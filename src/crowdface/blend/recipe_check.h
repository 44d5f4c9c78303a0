// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/blend/recipe.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/region/region_weights.h"

namespace crowdface {

/// \throws BrokenPrecondition if the recipe names a head that the face set has not, or if the regions are
/// not as many as the recipe's or not for this topology.
void require_fit(const FaceSet& faces, const RegionWeights& regions, const Recipe& recipe);

}  // namespace crowdface
