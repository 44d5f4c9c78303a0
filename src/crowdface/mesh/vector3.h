// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "crowdface/core/units.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// The unit vector along a signed coordinate axis.
inline Eigen::Vector3d unit_vector(Axis axis) {
  return axis.sign * Eigen::Vector3d::Unit(axis.index);
}

/// Row `i` of positions or normals as a column vector.
inline Eigen::Vector3d row3(const Positions& positions, Index i) {
  return positions.row(i).transpose();
}

}  // namespace crowdface
