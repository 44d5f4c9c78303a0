// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/band_order.h"

namespace crowdface {

void keep_order(RegionRecipe& region) {
  for (std::size_t b = 1; b < band_count(region); ++b) {
    const BandRecipe& coarser = band_of(region, b - 1);
    BandRecipe& band = band_of(region, b);
    if (band.iterations <= coarser.iterations) continue;
    band.iterations = coarser.iterations;
    band.smoothness = coarser.smoothness;
  }
}

}  // namespace crowdface
