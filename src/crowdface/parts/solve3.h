// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/parts/vector3.h"

namespace crowdface {

/// x of A x = b for a symmetric, positive definite A.
inline Eigen::Vector3d solve3(const double (&a)[3][3], const double (&b)[3]) {
  const Eigen::Vector3d c0(a[0][0], a[1][0], a[2][0]), c1(a[0][1], a[1][1], a[2][1]),
      c2(a[0][2], a[1][2], a[2][2]), right(b[0], b[1], b[2]);
  const double determinant = dot3(c0, cross3(c1, c2));
  return {dot3(right, cross3(c1, c2)) / determinant, dot3(c0, cross3(right, c2)) / determinant,
          dot3(c0, cross3(c1, right)) / determinant};
}

}  // namespace crowdface
