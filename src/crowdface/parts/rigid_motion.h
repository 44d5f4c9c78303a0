// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Matrix times vector, in a fixed order of operations. A library's order may depend on the
/// machine.
inline Eigen::Vector3d multiply3(const Eigen::Matrix3d& map, const Eigen::Vector3d& v) {
  return {map(0, 0) * v.x() + map(0, 1) * v.y() + map(0, 2) * v.z(),
          map(1, 0) * v.x() + map(1, 1) * v.y() + map(1, 2) * v.z(),
          map(2, 0) * v.x() + map(2, 1) * v.y() + map(2, 2) * v.z()};
}

/// A similarity: rotation, uniform scaling and translation, x ↦ scale · R (x − pivot) +
/// moved_pivot. Computed with plain arithmetic, so that the bits are the same on every machine.
/// (The factorisation behind `Similarity` in mesh/alignment.h depends on the library.)
struct RigidMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double scale = 1;
  /// `pivot`: centre of rotation and scaling. `moved_pivot`: this centre after the motion.
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero(), moved_pivot = Eigen::Vector3d::Zero();

  Eigen::Vector3d apply(const Eigen::Vector3d& point) const;
  /// Applies the inverse of the motion to a point.
  Eigen::Vector3d apply_inverse(const Eigen::Vector3d& point) const;
  /// Applies the rotation and the scaling of the motion to a direction, without the translation.
  Eigen::Vector3d apply_to_direction(const Eigen::Vector3d& direction) const;
};

/// Applies the motion to each point (row) of `positions`.
void move_rows(const RigidMotion& motion, Positions& positions);
/// Returns the inverse motion.
RigidMotion inverse(const RigidMotion& motion);

/// Returns the axes of a head after a motion.
inline HeadAxes moved_axes(const HeadAxes& axes, const RigidMotion& motion) {
  return {.front = motion.apply_to_direction(axes.front) / motion.scale,
          .up = motion.apply_to_direction(axes.up) / motion.scale};
}

/// Returns the motion followed by a small translation, rotation and scaling about a pivot.
/// \param pivot   The pivot, in its position after `motion`.
/// \param rotation_vector  Rotation axis times angle (small).
/// \param growth  Relative change of scale; 0 keeps the size.
RigidMotion nudged(const RigidMotion& motion, const Eigen::Vector3d& pivot,
                   const Eigen::Vector3d& shift, const Eigen::Vector3d& rotation_vector,
                   double growth);

/// Returns the motion that best maps rows of `source` to the same rows of `target`, by weighted
/// least squares (Umeyama 1991), with the rotation as quaternion (Horn 1987).
///
/// \param vertices  Row indices of `source` and `target`; at least three rows that are not
///                  collinear.
/// \param weights   #vertices; not negative, with a positive sum.
RigidMotion fit_rigid_motion(const Positions& source, const Positions& target,
                             std::span<const std::uint32_t> vertices,
                             std::span<const double> weights);

}  // namespace crowdface
