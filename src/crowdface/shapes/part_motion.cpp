// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/part_motion.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/component_shape.h"
#include "crowdface/shapes/frame_field.h"

namespace crowdface {
namespace {

using Eigen::Vector3d;

/// Returns the quaternion (w, x, y, z) of a rotation by less than 180°.
std::array<double, 4> quaternion_of(const RigidMotion& motion) {
  constexpr double kMin = 1e-6;
  const Eigen::Matrix3d& r = motion.rotation;
  const double w = std::sqrt(std::max(1 + r(0, 0) + r(1, 1) + r(2, 2), kMin)) / 2;
  return {w, (r(2, 1) - r(1, 2)) / (4 * w), (r(0, 2) - r(2, 0)) / (4 * w),
          (r(1, 0) - r(0, 1)) / (4 * w)};
}

void normalize(std::array<double, 4>& q) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& part : q) part /= length;
}

Vector3d turned(const std::array<double, 4>& q, const Vector3d& v) {
  const Vector3d axis(q[1], q[2], q[3]);
  const Vector3d once = 2 * axis.cross(v);
  return v + q[0] * once + axis.cross(once);
}

/// Transforms a direction from the face to the template, by the inverse of the face's rotation and
/// scale.
Vector3d to_template(const RigidMotion& face_motion, const Vector3d& direction) {
  return face_motion.apply_inverse(face_motion.moved_pivot + direction) - face_motion.pivot;
}

/// Returns the displacement of a vertex by the rotation alone.
Vector3d rotation_displacement(const std::array<double, 4>& quaternion, const PlacedPart& placed,
                               std::uint32_t vertex) {
  const Vector3d arm = row3(placed.mesh, vertex) - placed.centre;
  return placed.face_motion.apply_to_direction(
             turned(quaternion, to_template(placed.face_motion, arm))) -
         arm;
}

RigidMotion motion_in_shape(const RigidPart& part, const Positions& mesh,
                            std::span<const std::uint32_t> vertices,
                            std::span<const std::uint32_t> rows, const Positions& moves) {
  const Positions rest = mesh(part.fitted_vertices, kAllColumns);
  Positions shape = rest;
  std::vector<std::uint32_t> all(part.fitted_vertices.size());
  std::iota(all.begin(), all.end(), 0U);
  for (const std::uint32_t i : all) {
    const std::uint32_t place = index_in_list(vertices, part.fitted_vertices[i]);
    if (place != kNoIndex) shape.row(i) += moves.row(rows[place]);
  }
  return fit_rigid_motion(rest, shape, all, part.equal_weights);
}

}  // namespace

PlacedPart::PlacedPart(const RigidPart& part, const Positions& neutral, const Positions& positions,
                       const RigidMotion& motion, const Eigen::Matrix3d& skin)
    : centre(fit_rigid_motion(neutral, positions, part.fitted_vertices, part.equal_weights)
                 .apply(part.centre)),
      mesh(positions),
      face_motion(motion),
      map(skin) {}

PartMotion find_part_motion(const RigidPart& part, const PlacedPart& placed,
                            std::span<const std::uint32_t> vertices,
                            std::span<const std::uint32_t> rows, const Positions& moves) {
  const RigidMotion motion = motion_in_shape(part, placed.mesh, vertices, rows, moves);
  const Eigen::Matrix3d inverse = inverse3(placed.map);
  const std::array<double, 4> here = quaternion_of(motion);
  const Vector3d axis =
      to_template(placed.face_motion, {here[1], here[2], here[3]}) * placed.face_motion.scale;
  PartMotion part_motion{{here[0], axis.x(), axis.y(), axis.z()},
                         multiply3(inverse, motion.apply(placed.centre) - placed.centre),
                         {}};
  normalize(part_motion.quaternion);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Vector3d left =
        row3(moves, rows[i]) - rotation_displacement(part_motion.quaternion, placed, vertices[i]);
    part_motion.residuals.push_back(multiply3(inverse, left) - part_motion.translation);
  }
  return part_motion;
}

PartMotion mean_part_motion(std::span<const PartMotion> motions,
                            std::span<const ShapeSetShare> shares) {
  PartMotion mean{{0, 0, 0, 0}, {0, 0, 0}, {}};
  mean.residuals.assign(motions.front().residuals.size(), Vector3d::Zero());
  for (const ShapeSetShare& of_set : shares) {
    const PartMotion& part_motion = motions[of_set.set];
    for (std::size_t c = 0; c < 4; ++c)
      mean.quaternion[c] += of_set.blend_weight * part_motion.quaternion[c];
    mean.translation += of_set.blend_weight * part_motion.translation;
    for (std::size_t i = 0; i < mean.residuals.size(); ++i) {
      mean.residuals[i] += of_set.blend_weight * part_motion.residuals[i];
    }
  }
  normalize(mean.quaternion);
  return mean;
}

void transfer_part_motion(const PartMotion& part_motion, const PlacedPart& placed,
                          std::span<const std::uint32_t> vertices,
                          std::span<const std::uint32_t> rows, Positions& moves) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    moves.row(rows[i]) = (rotation_displacement(part_motion.quaternion, placed, vertices[i]) +
                          multiply3(placed.map, part_motion.translation + part_motion.residuals[i]))
                             .transpose();
  }
}

}  // namespace crowdface
