// SPDX-License-Identifier: Apache-2.0
#include "crowdface/blend/blend.h"

#include "crowdface/blend/recipe_check.h"
#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

const Positions& positions_of(const FaceSet& faces, Index head) {
  return faces.heads[static_cast<std::size_t>(head)].positions;
}

/// D_k = B − e_k Σ_i ω̂_ki C_i, side by side for all regions: #V by 3·regions.
Columns target_less_sources(const FaceSet& faces, const Recipe& recipe) {
  const Positions& target = positions_of(faces, recipe.target);
  Columns difference(target.rows(), 3 * static_cast<Index>(recipe.regions.size()));
  parallel_blocks(target.rows(), kRowBlock, [&](Index begin, Index end) {
    for (std::size_t k = 0; k < recipe.regions.size(); ++k) {
      const RegionRecipe& region = recipe.regions[k];
      auto columns = difference.block(begin, 3 * static_cast<Index>(k), end - begin, 3);
      columns.setZero();
      for (const SourceWeight& source : region.weights) {
        columns +=
            source.weight * positions_of(faces, source.head).middleRows(begin, end - begin);  // C̄_k
      }
      columns = target.middleRows(begin, end - begin) - region.extrapolation * columns;
    }
  });
  return difference;
}

}  // namespace

Positions blend_exact(const FaceSet& faces, const ChebyshevFilter& filter,
                      const RegionWeights& regions, const Recipe& recipe) {
  require_fit(faces, regions, recipe);
  const Columns difference = target_less_sources(faces, recipe);
  std::vector<ChebyshevSeries> series;
  for (const RegionRecipe& region : recipe.regions) {
    series.push_back(power_series(filter.kind(), region.iterations));
  }
  const Columns smoothed = filter_each(filter, difference, series);
  Positions result = positions_of(faces, recipe.target);
  parallel_blocks(result.rows(), kRowBlock, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      for (Index k = 0; k < regions.alpha.cols(); ++k) {
        const double alpha = regions.alpha(i, k);
        for (Index c = 0; c < 3; ++c) {
          result(i, c) += alpha * (smoothed(i, 3 * k + c) - difference(i, 3 * k + c));  // Eq. 7
        }
      }
    }
  });
  return result;
}

}  // namespace crowdface
