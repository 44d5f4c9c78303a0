// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "crowdface/core/units.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

inline Eigen::Vector3d unit_vector(Axis axis) {
  return axis.sign * Eigen::Vector3d::Unit(axis.index);
}

/// Row `i` of positions, or of normals, as a vector.
inline Eigen::Vector3d row3(const Positions& positions, Index i) {
  return positions.row(i).transpose();
}

// Eigen's own products choose their order by the instruction set; these stay in meshes.

inline double dot3(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}
inline Eigen::Vector3d cross3(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
          a.x() * b.y() - a.y() * b.x()};
}
inline double length3(const Eigen::Vector3d& a) {
  return std::sqrt(dot3(a, a));
}
/// Zero stays zero.
inline Eigen::Vector3d unit3(const Eigen::Vector3d& a) {
  const double length = length3(a);
  return length > 0 ? Eigen::Vector3d(a / length) : Eigen::Vector3d(0, 0, 0);
}

}  // namespace crowdface
