// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/vertex_colours_blend.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/parallel.h"
#include "crowdface/texture/optical_density.h"

namespace crowdface {
namespace {

constexpr Index kColouredPerBlock = 4096;

/// Normalizes the weights over the heads that have colours. If all these weights are zero, the
/// heads with colours get equal weights.
std::vector<double> normalized_over_coloured(std::vector<double> weights,
                                             const std::vector<ColourRows>& heads) {
  double sum = 0, count = 0;
  for (std::size_t h = 0; h < heads.size(); ++h) {
    if (heads[h].rows() == 0) weights[h] = 0;
    sum += weights[h];
    count += heads[h].rows() > 0 ? 1 : 0;
  }
  for (std::size_t h = 0; h < heads.size(); ++h) {
    if (heads[h].rows() > 0) weights[h] = sum > 0 ? weights[h] / sum : 1 / count;
  }
  return weights;
}

}  // namespace

ColourRows blend_vertex_colours(const std::vector<ColourRows>& heads,
                                const FaceColourWeights& weights,
                                const std::vector<bool>& uses_target_colours_only) {
  const std::vector<double> whole = normalized_over_coloured(weights.weights_for_skin, heads),
                            target =
                                normalized_over_coloured(weights.weights_for_eyes_and_teeth, heads);
  const auto first = std::ranges::find_if(heads, [](const auto& rows) { return rows.rows() > 0; });
  ColourRows blended(first->rows(), 3);
  const std::vector<Density>& densities = density_by_srgb8();
  const std::vector<std::uint8_t>& bytes = srgb8_by_density();
  parallel_blocks(blended.rows(), kColouredPerBlock, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v) {
      const bool is_part = !uses_target_colours_only.empty() &&
                           uses_target_colours_only[static_cast<std::size_t>(v)];
      const std::vector<double>& weights_of_vertex = is_part ? target : whole;
      for (Index c = 0; c < 3; ++c) {
        double density = 0;
        for (std::size_t h = 0; h < heads.size(); ++h) {
          if (weights_of_vertex[h] > 0) density += weights_of_vertex[h] * densities[heads[h](v, c)];
        }
        const long nearest = std::lround(density);
        blended(v, c) =
            bytes[static_cast<std::size_t>(std::min(nearest, static_cast<long>(bytes.size()) - 1))];
      }
    }
  });
  return blended;
}

}  // namespace crowdface
