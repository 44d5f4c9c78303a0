// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include <Eigen/LU>

#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/heads/body_below_neck.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/heads/load_transferred.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/edge_distances.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/neck/head_rotations.h"

namespace crowdface {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double rms_length(const Positions& rows) {
  return rows.rowwise().norm().norm() / std::sqrt(static_cast<double>(rows.rows()));
}

Vector3d ring_middle(const Positions& rim) {
  Vector3d sum = Vector3d::Zero();
  for (Index i = 0; i < rim.rows(); ++i) sum += row3(rim, i);
  return sum / static_cast<double>(rim.rows());
}

/// At most 2000 vertices, evenly spaced by index, of the skin that the bend of the neck does not
/// move. If the bend leaves fewer than 100 vertices of the skin unmoved, the vertices are chosen
/// from the whole skin.
std::vector<std::uint32_t> skin_above(const Inputs& inputs, const Positions& mean, const Rim& rim,
                                      double falloff) {
  constexpr std::size_t kPoints = 2000, kFewest = 100;
  EdgeDistances distances(inputs.adjacency, mean);
  distances.search(rim, falloff);
  std::vector<std::uint32_t> above, all;
  for (std::uint32_t v = 0; v < inputs.components.component_of_vertex.size(); ++v) {
    if (inputs.components.component_of_vertex[v] != inputs.components.largest()) continue;
    all.push_back(v);
    if (!std::isfinite(distances.distance(v))) above.push_back(v);
  }
  return evenly_spaced_items(above.size() < kFewest ? all : above, kPoints);
}

/// Returns the rotation of all heads that aligns their ring `rim` with the body's ring `goal`.
/// Returns the identity if this rotation leaves more than half of the distance between the rings.
/// Necks are cut at different slopes, and a different slope alone must not tilt the heads.
Matrix3d rotation_of_rim(const Positions& rim, const Positions& goal) {
  std::vector<std::uint32_t> all(static_cast<std::size_t>(rim.rows()));
  std::iota(all.begin(), all.end(), 0U);
  RigidMotion turned = fit_rigid_motion(rim, goal, all, std::vector<double>(all.size(), 1.0));
  turned.scale = 1;
  const auto left = [&](const RigidMotion& motion) {
    double sum = 0;
    for (Index i = 0; i < rim.rows(); ++i) {
      sum += (motion.apply(row3(rim, i)) - row3(goal, i)).squaredNorm();
    }
    return sum;
  };
  constexpr double kHalf = 0.25;  // half the distance, squared
  const bool counts =
      left(turned) < kHalf * left({.pivot = turned.pivot, .moved_pivot = turned.moved_pivot});
  return counts ? turned.rotation : Matrix3d::Identity();
}

/// The poses of the heads, measured on the skin above the bend of the neck. `rotation_to` measures
/// the pose of another mesh with the same topology.
struct Poses {
  std::vector<std::uint32_t> skin;
  Vector3d across;              ///< the axis through the ears
  std::vector<Matrix3d> turns;  ///< rotation of each head into the common pose

  Poses(const Config& config, const HeadSet& heads, std::vector<std::uint32_t> vertices)
      : skin(std::move(vertices)),
        across(unit_vector(config.faces.up).cross(unit_vector(config.faces.front))) {
    std::vector<Positions> points;
    for (const Head& head : heads.heads) points.emplace_back(head.positions(skin, kAllColumns));
    turns = rotations_to_median(points, across);
  }

  /// The mean of the heads at some vertices, after each head is rotated by its turn and translated
  /// so that the centre of its rim lies at the mean of all rim centres.
  Positions mean(const HeadSet& heads, const Rim& rim,
                 std::span<const std::uint32_t> vertices) const {
    std::vector<Vector3d> middles;
    Vector3d to = Vector3d::Zero();
    for (const Head& head : heads.heads) {
      middles.push_back(ring_middle(head.positions(rim, kAllColumns)));
      to += middles.back() / static_cast<double>(heads.heads.size());
    }
    Positions sum = Positions::Zero(static_cast<Index>(vertices.size()), 3);
    for (std::size_t h = 0; h < turns.size(); ++h) {
      const RigidMotion motion{.rotation = turns[h], .pivot = middles[h], .moved_pivot = to};
      Positions own = heads.heads[h].positions(vertices, kAllColumns);
      move_rows(motion, own);
      sum += own;
    }
    return sum / static_cast<double>(turns.size());
  }

  /// Returns the rotation from the heads' common pose into the pose of `mesh`.
  /// \param mesh  vertex positions in the vertex order of the heads
  Matrix3d rotation_to(const HeadSet& heads, const Rim& rim, const Positions& mesh) const {
    return pose_difference(head_motion(mean(heads, rim, skin), mesh(skin, kAllColumns)).rotation,
                           across);
  }
};

/// The body on which the heads are placed, and the heads' rotation.
struct PlacementGoal {
  BodyBelowNeck body;
  /// rotation that turns all heads from their common pose into the pose that fits the body
  Matrix3d rotation = Matrix3d::Identity();
};

PlacementGoal find_goal(const Config& config, const Inputs& inputs, const Rim& rim,
                        const Poses& poses) {
  const HeadSet& head_set = inputs.head_set;
  PlacementGoal goal;
  if (!config.neck.body.empty()) {
    const Positions ring = poses.mean(head_set, rim, rim);
    goal.body = read_body_below_neck(config, inputs, rim, ring);
    goal.rotation = goal.body.file_contains_head
                        ? poses.rotation_to(head_set, rim, goal.body.head_positions)
                        : rotation_of_rim(ring, goal.body.rim_positions);
    return goal;
  }
  goal.body.area_vectors = Positions::Zero(static_cast<Index>(rim.size()), 3);
  if (!config.neck.neck_head) {
    goal.body.rim_positions = poses.mean(head_set, rim, rim);
    return goal;
  }
  const auto neck_head = static_cast<std::size_t>(*config.neck.neck_head);
  const Positions& head = head_set.heads[neck_head].positions;
  goal.body.rim_positions = head(rim, kAllColumns);
  goal.rotation = poses.rotation_to(head_set, rim, head);
  return goal;
}

/// Warns about heads whose ring lies so far from the body's ring that the bend of the neck is
/// visible.
void warn_of_visible_bends(const Config& config, const std::vector<HeadsOnBody::Head>& heads,
                           Inputs& inputs) {
  // The displacement at which the bend's largest slope is one half. The largest slope is 1.5 times
  // the displacement divided by the falloff.
  const double most = config.neck.falloff_mm / 3;
  std::vector<std::string> bent;
  for (std::size_t h = 0; h < heads.size(); ++h) {
    if (heads[h].max_bend_mm <= most) continue;
    bent.push_back(
        concat(inputs.head_set.heads[h].name, " (", format_fixed(heads[h].max_bend_mm, 1), " mm)"));
  }
  if (bent.empty()) return;
  inputs.warn(concat("neck: the bend of the neck may be visible, because the rings of ", join(bent),
                     " are farther from the body's ring than ", format_fixed(most, 1),
                     " mm, the largest distance that a falloff of ", config.neck.falloff_mm,
                     " mm hides; a larger neck.falloff makes the bend smoother"));
}

/// Places a head on the body. All heads get the same rotation: different rotations would change the
/// differences between heads, and so the faces' identities. If the pose of a head differs from the
/// common pose, the finished faces that contain this head are rotated instead.
HeadsOnBody::Head place(const Rim& rim, const PlacementGoal& goal, const Matrix3d& turn, double mm,
                        Positions& head) {
  HeadsOnBody::Head placed;
  const Positions before = head(rim, kAllColumns);
  placed.rotation_degrees = Similarity{goal.rotation * turn}.angle_degrees();
  placed.pose_rotation = multiply3(goal.rotation, rotation_vector(turn));
  const Vector3d middle = ring_middle(goal.body.rim_positions);
  if (before != goal.body.rim_positions || !goal.rotation.isIdentity(0)) {
    placed.placement = {
        .rotation = goal.rotation, .pivot = ring_middle(before), .moved_pivot = middle};
    move_rows(placed.placement, head);
  }
  Positions after = head(rim, kAllColumns);
  if (!placed.pose_rotation.isZero(0))
    move_rows(rotation_about(middle, placed.pose_rotation), after);
  placed.shift_mm = mm * rms_length(after - before);
  placed.max_bend_mm = mm * (goal.body.rim_positions - after).rowwise().norm().maxCoeff();
  return placed;
}

/// The mean of the placed heads, after each head is rotated into the common pose.
Positions turned_mean(const HeadSet& heads, const std::vector<HeadsOnBody::Head>& placements,
                      const Vector3d& middle) {
  Positions mean = mean_head(heads);
  for (std::size_t h = 0; h < placements.size(); ++h) {
    if (placements[h].pose_rotation.isZero(0)) continue;
    Positions turned = heads.heads[h].positions;
    move_rows(rotation_about(middle, placements[h].pose_rotation), turned);
    mean += (turned - heads.heads[h].positions) / static_cast<double>(placements.size());
  }
  return mean;
}

Digest neck_digest(const Config& config, const HeadsOnBody& neck) {
  Hasher hasher;
  hasher.add_array(std::span(neck.seam.rim))
      .add_array(numbers_of(neck.seam.positions))
      .add_array(numbers_of(neck.seam.normals))
      .add(config.neck.falloff_mm);
  for (const HeadsOnBody::Head& head : neck.heads) {
    for (Index c = 0; c < 3; ++c) hasher.add(head.pose_rotation[c]);
  }
  if (neck.body) {
    hasher.add(neck.body->text_digest)
        .add(int{config.neck.show_body})
        .add(int{config.neck.write_body});
    hasher.add_array(std::span(neck.body_rim));
    for (const MaterialFile& file : neck.body->materials.files) {
      hasher.add(hash_file(file.source).digest);
    }
  }
  if (!config.neck.body_texture.empty()) hasher.add(hash_file(config.neck.body_texture).digest);
  return hasher.digest();
}

/// Returns the unit normals at the vertices of the neck's rim, one row for each vertex.
/// \param areas       the sum of the heads' area vectors around each vertex of the rim
/// \param body_areas  the sum of the body's area vectors around each vertex of the rim
Positions normals_of(Positions areas, const Positions& body_areas) {
  areas += body_areas;
  for (Index i = 0; i < areas.rows(); ++i) areas.row(i) = row3(areas, i).normalized().transpose();
  return areas;
}

void place_heads(const Config& config, Inputs& inputs) {
  HeadSet& head_set = inputs.head_set;
  const double mm = mm_per(config.faces.units), falloff = config.neck.falloff_mm / mm;
  const Rim rim = find_neck_rim(config, inputs);
  Positions mean_before_placement = mean_head(head_set);
  const Poses poses(config, head_set, skin_above(inputs, mean_before_placement, rim, falloff));
  PlacementGoal goal = find_goal(config, inputs, rim, poses);
  std::vector<HeadsOnBody::Head> heads(head_set.heads.size());
  parallel_for_each(heads.size(), [&](std::size_t h) {
    heads[h] = place(rim, goal, poses.turns[h], mm, head_set.heads[h].positions);
  });
  warn_of_visible_bends(config, heads, inputs);
  const Vector3d middle = ring_middle(goal.body.rim_positions);
  Positions mean = turned_mean(head_set, heads, middle);
  Seam seam{rim,
            goal.body.rim_positions,
            {},
            NeckBend(head_set.topology, inputs.adjacency, mean, rim, falloff)};
  seam.bend_to_seam(mean);
  const Positions areas = area_vectors_around(head_set.topology, mean, rim);
  goal.body.reverse_inward_polygons(areas);
  seam.normals = normals_of(areas, goal.body.area_vectors);
  HeadsOnBody neck{
      std::move(seam), std::move(heads),   middle, std::move(mean_before_placement), mm,
      goal.body.mesh,  goal.body.mesh_rim, {}};
  neck.digest = neck_digest(config, neck);
  inputs.heads_on_body = std::make_shared<const HeadsOnBody>(std::move(neck));
}

}  // namespace

void load_neck(const Config& config, Inputs& inputs, Problems& problems) {
  if (!config.neck.is_set()) return;
  try {
    place_heads(config, inputs);
  } catch (const RecoverableError& error) {
    problems.add(error.code(), concat(config.file.string(), ": neck: ", error.what()));
  }
}

}  // namespace crowdface
