// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/face_poses.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "crowdface/core/contains.h"
#include "crowdface/core/selection.h"
#include "crowdface/mesh/mirror_map.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/neck/head_rotations.h"

namespace crowdface {
namespace {

/// Returns the indices of at most 500 evenly spaced samples that the bend of the neck does not
/// move. If the bend leaves fewer than 100 samples unmoved, chooses from all samples.
std::vector<Index> indices_of_samples_above_bend(const Seam& seam, const FaceSamples& samples) {
  constexpr std::size_t kPoints = 500, kFewest = 100;
  std::vector<Index> all(samples.size()), above;
  std::iota(all.begin(), all.end(), Index{0});
  for (const Index s : all) {
    const std::uint32_t v = samples[static_cast<std::size_t>(s)];
    if (!std::ranges::binary_search(seam.neck_bend.vertices(), v) && !contains(seam.rim, v)) {
      above.push_back(s);
    }
  }
  return evenly_spaced_items(above.size() < kFewest ? all : above, kPoints);
}

HeadsAtSamples heads_above(const Inputs& inputs, const PreparedHeads& prepared,
                           const RegionWeights& regions) {
  const std::vector<Index> columns =
      indices_of_samples_above_bend(inputs.heads_on_body->seam, prepared.samples);
  FaceSamples samples;
  for (const Index s : columns) samples.push_back(prepared.samples[static_cast<std::size_t>(s)]);
  std::vector<Trajectory> own;
  for (const Trajectory& from : prepared.trajectories) {
    Trajectory& to = own.emplace_back(from.rows(), 3 * static_cast<Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i) {
      to.middleCols<3>(3 * static_cast<Index>(i)) = from.middleCols<3>(3 * columns[i]);
    }
  }
  HeadsAtSamples heads = sample_heads(inputs.head_set, regions, samples, own, inputs.max_level, 1);
  heads.owned_trajectories = std::move(own);
  heads.trajectories = heads.owned_trajectories;
  return heads;
}

/// Rotates each head into the common pose of all heads; the centre of rotation is the centroid of
/// the neck's ring. Rotates each head's trajectories (displacements of its vertices at several
/// smoothing levels) too, because smoothing commutes with rotations.
void turn_heads(const HeadsOnBody& neck, HeadsAtSamples& heads) {
  for (std::size_t h = 0; h < heads.heads.size(); ++h) {
    if (neck.heads[h].pose_rotation.isZero(0)) continue;
    const Positions before = heads.heads[h];
    const RigidMotion motion = rotation_about(neck.seam_centre, neck.heads[h].pose_rotation);
    move_rows(motion, heads.heads[h]);
    heads.mean += (heads.heads[h] - before) / static_cast<double>(heads.heads.size());
    Trajectory& moves = heads.owned_trajectories[h];
    for (Index l = 0; l < moves.rows(); ++l) {
      for (Index i = 0; i < moves.cols(); i += 3) {
        const Eigen::Vector3d by = moves.block<1, 3>(l, i).transpose().cast<double>();
        moves.block<1, 3>(l, i) = motion.apply_to_direction(by).transpose().cast<float>();
      }
    }
  }
}

Eigen::Matrix3d product(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  Eigen::Matrix3d result;
  for (Index c = 0; c < 3; ++c) result.col(c) = multiply3(a, b.col(c));
  return result;
}

/// The composed motion x ↦ a(b(x)). All motions in this file have the scale 1.
RigidMotion after(const RigidMotion& a, const RigidMotion& b) {
  return {.rotation = product(a.rotation, b.rotation),
          .pivot = b.pivot,
          .moved_pivot = a.apply(b.moved_pivot)};
}

/// Returns the motion m′ for mirror images: applying m′ after mirroring is the same as applying
/// `motion` before mirroring.
RigidMotion motion_of_mirror_image(const RigidMotion& motion, const MirrorPlane& plane) {
  const MirrorPlane directions{plane.normal, 0};
  Eigen::Matrix3d rotation;
  for (Index c = 0; c < 3; ++c) {
    const Eigen::Vector3d moved =
        multiply3(motion.rotation, directions.mirrored(Eigen::Vector3d::Unit(c)));
    rotation.col(c) = directions.mirrored(moved);
  }
  return {.rotation = rotation,
          .pivot = plane.mirrored(motion.pivot),
          .moved_pivot = plane.mirrored(motion.moved_pivot)};
}

/// Interpolates two motions. The image of `pivot` and the rotation vector are linear in w.
/// \param w  from 0 (gives a) to 1 (gives b)
RigidMotion between(const RigidMotion& a, const RigidMotion& b, double w,
                    const Eigen::Vector3d& pivot) {
  const auto mixed = [&](const Eigen::Vector3d& of_a, const Eigen::Vector3d& of_b) {
    return Eigen::Vector3d(of_a + w * (of_b - of_a));
  };
  return nudged({}, pivot, mixed(a.apply(pivot), b.apply(pivot)) - pivot,
                mixed(rotation_vector(a.rotation), rotation_vector(b.rotation)), 0);
}

}  // namespace

FacePoses::FacePoses(const Inputs& inputs, const PreparedHeads& prepared,
                     const RegionWeights& regions)
    : heads_on_body_(*inputs.heads_on_body),
      placed_heads_(heads_above(inputs, prepared, regions)),
      heads_in_common_pose_(placed_heads_) {
  heads_in_common_pose_.trajectories = heads_in_common_pose_.owned_trajectories;
  turn_heads(heads_on_body_, heads_in_common_pose_);
  mean_motion_ = head_motion(placed_heads_.mean, heads_in_common_pose_.mean);
}

std::optional<RigidMotion> FacePoses::motion_of(const Recipe& recipe,
                                                const MirrorPlane* plane) const {
  const bool is_turned = uses_rotated_head(recipe);
  if (!is_turned && is_unmirrored(recipe)) return std::nullopt;
  Recipe plain = recipe;
  plain.asymmetry = 1;
  plain.mirrored = false;
  RigidMotion motion;
  if (is_turned)
    motion =
        head_motion(sample_face(placed_heads_, plain), sample_face(heads_in_common_pose_, plain));
  if (is_unmirrored(recipe)) return motion;
  // `plane` is the symmetry plane of the mean of the placed heads. A face must be mirrored in the
  // symmetry plane of the common pose, which is the image of `plane` under `mean_motion_`.
  const RigidMotion back = inverse(mean_motion_);
  if (recipe.asymmetry != 1) {
    const RigidMotion of_image =
        after(mean_motion_, motion_of_mirror_image(after(back, motion), *plane));
    motion = between(motion, of_image, mirror_image_weight(recipe.asymmetry, false),
                     heads_on_body_.seam_centre);
  }
  return recipe.mirrored ? after(motion_of_mirror_image(mean_motion_, *plane), after(back, motion))
                         : motion;
}

bool FacePoses::uses_rotated_head(const Recipe& recipe) const {
  const auto is_turned = [&](const SourceWeight& part) {
    return !heads_on_body_.heads[static_cast<std::size_t>(part.head)].pose_rotation.isZero(0);
  };
  if (std::ranges::any_of(target_head_weights(recipe), is_turned)) return true;
  for (const RegionRecipe& region : recipe.regions) {
    for (std::size_t b = 0; b < band_count(region); ++b) {
      if (std::ranges::any_of(band_of(region, b).weights, is_turned)) return true;
    }
  }
  return false;
}

}  // namespace crowdface
