// SPDX-License-Identifier: Apache-2.0
#include "crowdface/blend/recipe_check.h"

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {

void require_fit(const FaceSet& faces, const RegionWeights& regions, const Recipe& recipe) {
  const auto wanted = static_cast<Index>(recipe.regions.size());
  if (regions.alpha.cols() != wanted || regions.alpha.rows() != faces.topology.vertex_count) {
    throw InvalidInput(concat("recipe ", recipe.id, ": expected masks for ",
                              faces.topology.vertex_count, " vertices and ", wanted,
                              " regions, found ", regions.alpha.rows(), " and ",
                              regions.alpha.cols()));
  }
  const auto heads = static_cast<Index>(faces.heads.size());
  const auto require_head = [&](Index head) {
    if (head < 0 || head >= heads) {
      throw InvalidInput(
          concat("recipe ", recipe.id, ": expected a head below ", heads, ", found ", head));
    }
  };
  require_head(recipe.target);
  for (const RegionRecipe& region : recipe.regions) {
    for (const SourceWeight& source : region.weights) require_head(source.head);
  }
}

}  // namespace crowdface
