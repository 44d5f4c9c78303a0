// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "crowdface/mesh/vector3.h"

namespace crowdface {

/// The directions up and front of a head, as unit vectors.
struct HeadAxes {
  Eigen::Vector3d front = {0, 0, 1}, up = {0, 1, 0};

  /// Returns the direction to the head's left.
  Eigen::Vector3d side() const { return up.cross(front); }
};

}  // namespace crowdface
