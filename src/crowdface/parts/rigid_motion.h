// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Written out: a library's product chooses its order by the machine.
inline Eigen::Vector3d apply3(const Eigen::Matrix3d& map, const Eigen::Vector3d& v) {
  return {map(0, 0) * v.x() + map(0, 1) * v.y() + map(0, 2) * v.z(),
          map(1, 0) * v.x() + map(1, 1) * v.y() + map(1, 2) * v.z(),
          map(2, 0) * v.x() + map(2, 1) * v.y() + map(2, 2) * v.z()};
}

/// x ↦ scale · R (x − from) + to, in plain arithmetic: what a rigid part makes when its face is
/// blended. (The Similarity of mesh/alignment.h rests on a factorisation whose bits are a library's.)
struct RigidMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double scale = 1;
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();

  Eigen::Vector3d apply(const Eigen::Vector3d& point) const;
  /// What apply carries to a point.
  Eigen::Vector3d undo(const Eigen::Vector3d& point) const;
  /// Of a direction: without the translations.
  Eigen::Vector3d turn(const Eigen::Vector3d& direction) const;
};

/// Which way a head looks that was moved so.
inline HeadAxes moved(const HeadAxes& axes, const RigidMotion& by) {
  return {.front = by.turn(axes.front) / by.scale, .up = by.turn(axes.up) / by.scale};
}

/// A motion after which a part is still shifted, turned and stretched a little about a place.
/// \param pivot   where the part is after the motion
/// \param turn    axis times angle, small
/// \param growth  0: of the same size
RigidMotion nudged(const RigidMotion& motion, const Eigen::Vector3d& pivot,
                   const Eigen::Vector3d& shift, const Eigen::Vector3d& turn, double growth);

/// The motion that carries rows of `from` nearest to the same rows of `to`, in the least-squares
/// sense (Umeyama 1991), the rotation as the quaternion of Horn 1987.
/// \param vertices  rows, at least three that are not on a line
/// \param weights   #vertices, not negative, of positive sum
RigidMotion fit_rigid_motion(const Positions& from, const Positions& to,
                             std::span<const std::uint32_t> vertices,
                             std::span<const double> weights);

}  // namespace crowdface
