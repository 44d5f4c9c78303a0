// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <utility>

#include <Eigen/Core>

namespace crowdface {

/// Two unit vectors that form an orthonormal basis with the unit vector `n` (Duff et al. 2017,
/// "Building an orthonormal basis, revisited").
inline std::pair<Eigen::Vector3f, Eigen::Vector3f> tangent_basis(const Eigen::Vector3f& n) {
  const float sign = std::copysign(1.0F, n.z());
  const float a = -1 / (sign + n.z());
  const float b = n.x() * n.y() * a;
  return {{1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()},
          {b, sign + n.y() * n.y() * a, -n.y()}};
}

}  // namespace crowdface
