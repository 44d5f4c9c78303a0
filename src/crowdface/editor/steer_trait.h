// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "crowdface/blend/recipe.h"

namespace crowdface {

/// A band of a region. The weights of this band may change.
struct SteeredBand {
  std::size_t region = 0, band = 0;  ///< indices of the region and of the band
  std::vector<Index> heads;          ///< heads that may contribute to the band, ascending
};

/// Changes the weights of bands so that a measurement comes as near to the value `wanted` as the
/// heads of the bands allow. Keeps the sum of squared changes small. Takes Newton steps along the
/// gradient, and projects the result of each step onto the weights that are not negative and sum to
/// one. Bands that hardly affect the measurement keep their weights. A band whose weights change
/// loses BandRecipe::position, its position on the weight plane, because the new weights belong to
/// no position.
/// \param measure  the measurement of a recipe; thread-safe
Recipe steer_trait(Recipe recipe, const std::vector<SteeredBand>& bands, double wanted,
                   const std::function<double(const Recipe&)>& measure);

}  // namespace crowdface
