// SPDX-License-Identifier: Apache-2.0
#include "crowdface/blend/blend.h"

#include "crowdface/blend/recipe_check.h"
#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

const Positions& positions_of(const HeadSet& heads, Index head) {
  return heads.heads[static_cast<std::size_t>(head)].positions;
}

/// One band of detail in one region.
struct SmoothedBand {
  Index region = 0;
  const BandRecipe* band = nullptr;
  bool is_coarsest = false;  ///< whether this is the coarsest band of its region
};

std::vector<SmoothedBand> bands_of(const Recipe& recipe) {
  std::vector<SmoothedBand> bands;
  for (std::size_t k = 0; k < recipe.regions.size(); ++k) {
    for (std::size_t b = 0; b < band_count(recipe.regions[k]); ++b) {
      bands.push_back({static_cast<Index>(k), &band_of(recipe.regions[k], b), b == 0});
    }
  }
  return bands;
}

/// Returns the weighted sums of heads that the blend smooths, one for each band of each region:
/// G_b in the comment of weights_by_level (recipe.h), for each region k. The result is a matrix
/// of #V by 3·#bands with three adjacent columns for each band. If each region has one band, these
/// sums are the differences D_k of blend_exact.
Columns band_differences(const HeadSet& heads, const std::vector<SmoothedBand>& bands,
                         const Positions& target) {
  Columns difference(target.rows(), 3 * static_cast<Index>(bands.size()));
  parallel_blocks(target.rows(), kRowsPerTask, [&](Index begin, Index end) {
    Positions coarser;
    for (std::size_t i = 0; i < bands.size(); ++i) {
      const BandRecipe& band = *bands[i].band;
      if (bands[i].is_coarsest) coarser = target.middleRows(begin, end - begin);
      Positions mean = Positions::Zero(end - begin, 3);
      for (const SourceWeight& source : band.weights) {
        mean +=
            source.weight * positions_of(heads, source.head).middleRows(begin, end - begin);  // C̄_k
      }
      mean *= band.extrapolation;
      difference.block(begin, 3 * static_cast<Index>(i), end - begin, 3) = coarser - mean;
      coarser.swap(mean);
    }
  });
  return difference;
}

}  // namespace

Positions target_positions(const HeadSet& heads, const Recipe& recipe) {
  return target_matrix<Positions>(
      recipe, [&](Index head) -> const Positions& { return positions_of(heads, head); });
}

void blend_exact(const HeadSet& heads, const ChebyshevFilter& filter, const RegionWeights& regions,
                 std::span<const Recipe* const> recipes, std::span<Positions> results) {
  std::vector<std::vector<SmoothedBand>> bands;
  std::vector<Columns> differences;
  std::vector<FilterInput<double>> inputs;
  for (std::size_t f = 0; f < recipes.size(); ++f) {
    const Recipe* recipe = recipes[f];
    require_recipe_fits(heads, regions, *recipe);
    results[f] = target_positions(heads, *recipe);
    bands.push_back(bands_of(*recipe));
    differences.push_back(band_differences(heads, bands.back(), results[f]));
    for (std::size_t b = 0; b < bands[f].size(); ++b) {
      inputs.push_back({filter.rows_of<double>(differences.back(), static_cast<Index>(b)),
                        {power_series(filter.kind(), bands[f][b].band->iterations)}});
    }
  }
  // Smooth the differences of all bands of all faces together, in one pass of the filter. See
  // band_differences.
  const auto smoothed = filter.run<double>(inputs);
  const auto* of_face = smoothed.data();
  for (std::size_t f = 0; f < recipes.size(); of_face += bands[f].size(), ++f) {
    parallel_blocks(results[f].rows(), kRowsPerTask, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        const std::size_t row = filter.row_of_vertex()[static_cast<std::size_t>(i)];
        for (std::size_t b = 0; b < bands[f].size(); ++b) {
          const double alpha = regions.alpha(i, bands[f][b].region);
          const double* level = of_face[b].front()[row].value;
          const Index column = 3 * static_cast<Index>(b);
          for (Index c = 0; c < 3; ++c) {
            results[f](i, c) += alpha * (level[c] - differences[f](i, column + c));  // Eq. 7
          }
        }
      }
    });
  }
}

Positions blend_exact(const HeadSet& heads, const ChebyshevFilter& filter,
                      const RegionWeights& regions, const Recipe& recipe) {
  const Recipe* one = &recipe;
  Positions result;
  blend_exact(heads, filter, regions, std::span(&one, 1), std::span(&result, 1));
  return result;
}

}  // namespace crowdface
