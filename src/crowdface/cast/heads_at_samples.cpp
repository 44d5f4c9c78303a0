// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/heads_at_samples.h"

#include <algorithm>
#include <unordered_map>

#include "crowdface/cast/float_kernels.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"

namespace crowdface {
namespace {

void find_sample_ranges(HeadsAtSamples& sampled) {
  // If two ranges of samples (see sample_ranges) are at most this number of samples apart, one
  // range replaces both ranges. A loop over the samples between both ranges costs less than another
  // range.
  constexpr Index kMaxJoinedGap = 8;
  for (Index k = 0; k < sampled.region_weights.cols(); ++k) {
    auto& sample_ranges = sampled.sample_ranges.emplace_back();
    for (Index s = 0; s < sampled.region_weights.rows(); ++s) {
      if (sampled.region_weights(s, k) == 0) continue;
      if (sample_ranges.empty() || s > sample_ranges.back().second + kMaxJoinedGap)
        sample_ranges.emplace_back(s, s);
      sample_ranges.back().second = s + 1;
    }
  }
}

/// Copies the positions of the samples on all heads, converts the positions to millimetres, and
/// computes the mean of the heads.
///
/// \param whole  whole(head) returns all positions of a head, or of the head's mirror image.
template <class Whole>
void copy_samples(const HeadSet& head_set, const FaceSamples& samples, const Whole& whole,
                  HeadsAtSamples& sampled) {
  const auto count = static_cast<Index>(samples.size());
  sampled.mean = Positions::Zero(count, 3);
  for (const Head& head : head_set.heads) {
    const Positions& positions = whole(head);
    Positions& rows = sampled.heads.emplace_back(count, 3);
    for (Index s = 0; s < count; ++s) {
      rows.row(s) = sampled.mm_per_unit * positions.row(samples[static_cast<std::size_t>(s)]);
    }
    sampled.mean += rows;
  }
  sampled.mean /= static_cast<double>(head_set.heads.size());
}

Positions target_samples(const HeadsAtSamples& heads, const Recipe& recipe) {
  return target_matrix<Positions>(recipe, [&](Index head) -> const Positions& {
    return heads.heads[static_cast<std::size_t>(head)];
  });
}

Positions blended_samples(const HeadsAtSamples& heads, const Recipe& recipe) {
  Positions face = target_samples(heads, recipe);
  // The sum of the displacements has single precision, which is precise enough and saves time:
  // casting calls this function for every accepted face.
  std::vector<float> change(static_cast<std::size_t>(face.size()));
  for (std::size_t k = 0; k < recipe.regions.size(); ++k) {
    std::fill(change.begin(), change.end(), 0.F);
    // For each level L of the region (see weights_by_level), add S_L G − G: the displacements by
    // which smoothing moves the region's samples. G is the sum of the heads, weighted with the
    // level's weights.
    for (const LevelWeights& at : weights_by_level(recipe, k)) {
      for (const WeightedTrajectoryRow& level : interpolation_rows(heads.levels, at.level)) {
        for (const SourceWeight& part : at.weights) {
          const Trajectory& trajectory = heads.trajectories[static_cast<std::size_t>(part.head)];
          const float* row = trajectory.data() + level.row * trajectory.cols();
          const auto f = static_cast<float>(part.weight * level.weight * heads.mm_per_unit);
          for (const auto& [begin, end] : heads.sample_ranges[k]) {
            add_scaled(f, row + 3 * begin, static_cast<std::size_t>(3 * (end - begin)),
                       change.data() + 3 * begin);
          }
        }
      }
    }
    for (const auto& [begin, end] : heads.sample_ranges[k]) {
      for (Index s = begin; s < end; ++s) {
        const double alpha = heads.region_weights(s, static_cast<Index>(k));
        for (Index c = 0; c < 3; ++c) {
          face(s, c) += alpha * static_cast<double>(change[static_cast<std::size_t>(3 * s + c)]);
        }
      }
    }
  }
  return face;  // Eq. 7
}

/// Returns property(heads), property(mirror images of the heads), or a blend of both, as the
/// recipe's mirroring and asymmetry require.
template <class Property>
Positions mirrored_as(const HeadsAtSamples& heads, const Recipe& recipe, const Property& property) {
  const double w = mirror_image_weight(recipe);
  if (w == 0) return property(heads);
  require(heads.mirror_images != nullptr, "a mirrored face, and no mirror images of heads");
  if (w == 1) return property(*heads.mirror_images);
  return blend_with_mirrored(property(heads), property(*heads.mirror_images), w);
}

}  // namespace

HeadsAtSamples sample_heads(const HeadSet& head_set, const RegionWeights& regions,
                            const FaceSamples& samples, std::span<const Trajectory> trajectories,
                            std::uint64_t max_level, double mm_per_unit) {
  const auto count = static_cast<Index>(samples.size());
  HeadsAtSamples sampled;
  sampled.trajectories = trajectories;
  sampled.levels = stored_smoothing_levels(max_level);
  sampled.mm_per_unit = mm_per_unit;
  copy_samples(
      head_set, samples, [](const Head& head) -> const Positions& { return head.positions; },
      sampled);
  sampled.region_weights.resize(count, regions.alpha.cols());
  for (Index s = 0; s < count; ++s) {
    sampled.region_weights.row(s) = regions.alpha.row(samples[static_cast<std::size_t>(s)]);
  }
  find_sample_ranges(sampled);
  return sampled;
}

std::shared_ptr<const HeadsAtSamples> sample_mirror_images(const HeadSet& head_set,
                                                           const RegionWeights& regions,
                                                           const MirrorMap& mirror,
                                                           const FaceSamples& samples,
                                                           const FaceSamples& trajectory_vertices,
                                                           const HeadsAtSamples& heads) {
  const auto count = static_cast<Index>(samples.size());
  std::unordered_map<std::uint32_t, Index> column;
  for (std::size_t i = 0; i < trajectory_vertices.size(); ++i)
    column[trajectory_vertices[i]] = 3 * static_cast<Index>(i);
  auto images = std::make_shared<HeadsAtSamples>();
  images->levels = heads.levels;
  images->mm_per_unit = heads.mm_per_unit;
  copy_samples(
      head_set, samples, [&](const Head& head) { return mirrored(mirror, head.positions); },
      *images);
  images->region_weights = Columns::Zero(count, regions.alpha.cols());
  images->owned_trajectories.resize(head_set.heads.size());
  for (Trajectory& own : images->owned_trajectories) {
    own.resize(static_cast<Index>(heads.levels.size()), 3 * count);
  }
  const MirrorPlane directions{mirror.plane.normal, 0};
  for (Index s = 0; s < count; ++s) {
    const std::uint32_t v = samples[static_cast<std::size_t>(s)];
    for (std::size_t c = 0; c < 3; ++c) {
      images->region_weights.row(s) +=
          mirror.barycentric[v][c] * regions.alpha.row(mirror.corners[v][c]);
    }
  }
  parallel_for_each(images->owned_trajectories.size(), [&](std::size_t h) {
    const Trajectory& from = heads.trajectories[h];
    for (Index l = 0; l < from.rows(); ++l) {
      for (Index s = 0; s < count; ++s) {
        const std::uint32_t v = samples[static_cast<std::size_t>(s)];
        Eigen::Vector3d moved = Eigen::Vector3d::Zero();
        for (std::size_t c = 0; c < 3; ++c) {
          const Index at = column.at(mirror.corners[v][c]);
          for (Index a = 0; a < 3; ++a) {
            moved(a) += mirror.barycentric[v][c] * static_cast<double>(from(l, at + a));
          }
        }
        const Eigen::Vector3d turned = directions.mirrored(moved);
        for (Index a = 0; a < 3; ++a) {
          images->owned_trajectories[h](l, 3 * s + a) = static_cast<float>(turned(a));
        }
      }
    }
  });
  images->trajectories = images->owned_trajectories;
  find_sample_ranges(*images);
  return images;
}

Positions sample_target(const HeadsAtSamples& heads, const Recipe& recipe) {
  return mirrored_as(heads, recipe,
                     [&](const HeadsAtSamples& of) { return target_samples(of, recipe); });
}

Positions sample_face(const HeadsAtSamples& heads, const Recipe& recipe) {
  return mirrored_as(heads, recipe,
                     [&](const HeadsAtSamples& of) { return blended_samples(of, recipe); });
}

}  // namespace crowdface
