// SPDX-License-Identifier: Apache-2.0
#include "crowdface/blend/recipe_check.h"

#include "crowdface/core/require.h"

namespace crowdface {

void require_recipe_fits(const HeadSet& heads, const RegionWeights& regions, const Recipe& recipe) {
  const Index vertices = heads.topology.vertex_count;
  const auto wanted = static_cast<Index>(recipe.regions.size());
  require(regions.alpha.rows() == vertices && regions.alpha.cols() == wanted, "blend: a recipe of ",
          wanted, " regions on ", vertices, " vertices, masks of ", regions.alpha.cols(),
          " regions on ", regions.alpha.rows(), " vertices");
  const auto head_count = static_cast<Index>(heads.heads.size());
  const auto require_head = [&](Index head) {
    require(head >= 0 && head < head_count, "blend: a recipe names head ", head, " of ",
            head_count);
  };
  require_head(recipe.target);
  for (const SourceWeight& part : recipe.mixture) require_head(part.head);
  for (const RegionRecipe& region : recipe.regions) {
    for (std::size_t b = 0; b < band_count(region); ++b) {
      const BandRecipe& band = band_of(region, b);
      for (const SourceWeight& source : band.weights) require_head(source.head);
      require(b == 0 || band.iterations <= band_of(region, b - 1).iterations,
              "blend: a band that begins at a higher level than the coarser one before it");
    }
  }
}

}  // namespace crowdface
