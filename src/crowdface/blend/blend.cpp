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
Columns target_less_sources(const FaceSet& faces, const Recipe& recipe, const Positions& target) {
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

Positions target_positions(const FaceSet& faces, const Recipe& recipe) {
  return target_matrix<Positions>(
      recipe, [&](Index head) -> const Positions& { return positions_of(faces, head); });
}

void blend_exact(const FaceSet& faces, const ChebyshevFilter& filter, const RegionWeights& regions,
                 std::span<const Recipe* const> recipes, std::span<Positions> results) {
  std::vector<Columns> differences;
  std::vector<FilterInput<double>> inputs;
  for (std::size_t f = 0; f < recipes.size(); ++f) {
    const Recipe* recipe = recipes[f];
    require_fit(faces, regions, *recipe);
    results[f] = target_positions(faces, *recipe);
    differences.push_back(target_less_sources(faces, *recipe, results[f]));
    for (std::size_t k = 0; k < recipe->regions.size(); ++k) {
      inputs.push_back({filter.rows_of<double>(differences.back(), static_cast<Index>(k)),
                        {power_series(filter.kind(), recipe->regions[k].iterations)}});
    }
  }
  const auto smoothed = filter.run<double>(inputs);
  const Index region_count = regions.alpha.cols();
  for (std::size_t f = 0; f < recipes.size(); ++f) {
    const auto* of_face = smoothed.data() + f * static_cast<std::size_t>(region_count);
    parallel_blocks(results[f].rows(), kRowBlock, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        const std::size_t row = filter.row_of_vertex()[static_cast<std::size_t>(i)];
        for (Index k = 0; k < region_count; ++k) {
          const double alpha = regions.alpha(i, k);
          const double* level = of_face[k].front()[row].value;
          for (Index c = 0; c < 3; ++c) {
            results[f](i, c) += alpha * (level[c] - differences[f](i, 3 * k + c));  // Eq. 7
          }
        }
      }
    });
  }
}

Positions blend_exact(const FaceSet& faces, const ChebyshevFilter& filter,
                      const RegionWeights& regions, const Recipe& recipe) {
  const Recipe* one = &recipe;
  Positions result;
  blend_exact(faces, filter, regions, std::span(&one, 1), std::span(&result, 1));
  return result;
}

}  // namespace crowdface
