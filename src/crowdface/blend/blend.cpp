// SPDX-License-Identifier: Apache-2.0
#include "crowdface/blend/blend.h"

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

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

/// How much of S̃_L X − X each head X adds in a region: the target 1 (B̃^L − B), each source −e·ω̂
/// (D̃, Eq. 5). Where a head is both they are added first, so that the target blended with itself
/// leaves no trace.
std::vector<double> head_shares(Index target, const RegionRecipe& region, std::size_t heads) {
  std::vector<double> shares(heads, 0.0);
  shares[static_cast<std::size_t>(target)] = 1;
  for (const SourceWeight& source : region.weights) {
    shares[static_cast<std::size_t>(source.head)] -= region.extrapolation * source.weight;
  }
  return shares;
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

Positions blend_levels(const FaceSet& faces, std::span<const HeadLevels> levels,
                       const RegionWeights& regions, const Recipe& recipe) {
  require_fit(faces, regions, recipe);
  if (levels.size() != faces.heads.size()) {
    throw InvalidInput(concat("recipe ", recipe.id, ": expected fitted levels of ",
                              faces.heads.size(), " heads, found ", levels.size()));
  }
  Positions result = positions_of(faces, recipe.target);
  for (std::size_t r = 0; r < recipe.regions.size(); ++r) {
    const RegionRecipe& region = recipe.regions[r];
    const std::vector<double> shares = head_shares(recipe.target, region, levels.size());
    for (std::size_t h = 0; h < shares.size(); ++h) {
      if (shares[h] == 0) continue;
      const HeadLevels& fitted = levels[h];
      const std::vector<double> functions = fitted.functions(region.iterations);
      parallel_blocks(result.rows(), kRowBlock, [&](Index begin, Index end) {
        for (std::size_t p = 0; p < functions.size(); ++p) {
          const float* field = fitted.fields.data() + static_cast<Index>(p) * result.size();
          for (Index i = begin; i < end; ++i) {
            const double share =
                regions.alpha(i, static_cast<Index>(r)) * (shares[h] * functions[p]);
            for (Index c = 0; c < 3; ++c) {
              result(i, c) += share * static_cast<double>(field[3 * i + c]);
            }
          }
        }
      });
    }
  }
  return result;
}

}  // namespace crowdface
