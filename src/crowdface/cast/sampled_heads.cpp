// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/sampled_heads.h"

#include <algorithm>

namespace crowdface {

SampledHeads sample_heads(const FaceSet& faces, const RegionWeights& regions,
                          const FaceSamples& samples, std::span<const Trajectory> trajectories,
                          std::uint64_t max_level, double mm_per_unit) {
  const auto count = static_cast<Index>(samples.size());
  SampledHeads sampled;
  sampled.trajectories = trajectories;
  sampled.levels = trajectory_levels(max_level);
  sampled.mm_per_unit = mm_per_unit;
  sampled.mean = Positions::Zero(count, 3);
  for (const Head& head : faces.heads) {
    Positions& rows = sampled.heads.emplace_back(count, 3);
    for (Index s = 0; s < count; ++s) {
      rows.row(s) = mm_per_unit * head.positions.row(samples[static_cast<std::size_t>(s)]);
    }
    sampled.mean += rows;
  }
  sampled.mean /= static_cast<double>(faces.heads.size());
  sampled.alpha.resize(count, regions.alpha.cols());
  for (Index s = 0; s < count; ++s) {
    sampled.alpha.row(s) = regions.alpha.row(samples[static_cast<std::size_t>(s)]);
  }
  constexpr Index kGap = 8;  // a short one costs less than another stretch
  for (Index k = 0; k < sampled.alpha.cols(); ++k) {
    auto& stretches = sampled.stretches.emplace_back();
    for (Index s = 0; s < count; ++s) {
      if (sampled.alpha(s, k) == 0) continue;
      if (stretches.empty() || s > stretches.back().second + kGap) stretches.emplace_back(s, s);
      stretches.back().second = s + 1;
    }
  }
  return sampled;
}

Extrapolation extrapolation_of(Variant variant) {
  return variant == Variant::kUnit ? Extrapolation::kNone : Extrapolation::kAsGiven;
}

Positions sample_target(const SampledHeads& heads, const Recipe& recipe) {
  return target_matrix<Positions>(recipe, [&](Index head) -> const Positions& {
    return heads.heads[static_cast<std::size_t>(head)];
  });
}

Positions sample_face(const SampledHeads& heads, const Recipe& recipe, Variant variant) {
  Positions face = sample_target(heads, recipe);
  // In single precision, as the trajectories are: casting does this for every face it accepts.
  std::vector<float> change(static_cast<std::size_t>(face.size()));
  for (std::size_t k = 0; k < recipe.regions.size(); ++k) {
    std::fill(change.begin(), change.end(), 0.F);
    // S_L G − G at the region's samples, for each of its levels.
    for (const LevelShares& at : level_shares(recipe, k, extrapolation_of(variant))) {
      for (const LevelTerm& term : level_terms(heads.levels, at.level)) {
        for (const SourceWeight& part : at.shares) {
          const Trajectory& trajectory = heads.trajectories[static_cast<std::size_t>(part.head)];
          const float* row = trajectory.data() + term.row * trajectory.cols();
          const auto f = static_cast<float>(part.weight * term.factor * heads.mm_per_unit);
          for (const auto& [begin, end] : heads.stretches[k]) {
            float* out = change.data();
            for (Index i = 3 * begin; i < 3 * end; ++i) out[i] += f * row[i];
          }
        }
      }
    }
    for (const auto& [begin, end] : heads.stretches[k]) {
      for (Index s = begin; s < end; ++s) {
        const double alpha = heads.alpha(s, static_cast<Index>(k));
        for (Index c = 0; c < 3; ++c) {
          face(s, c) += alpha * static_cast<double>(change[static_cast<std::size_t>(3 * s + c)]);
        }
      }
    }
  }
  return face;  // Eq. 7
}

}  // namespace crowdface
