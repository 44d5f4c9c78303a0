// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "head_models/synth/lattice.h"

namespace crowdface::synth {

/// Where a place on the skin lies in the texture tile [0, 1]², without overlaps. The strip is cut
/// open down the back of the head, the cap hangs on to the forehead.
Eigen::RowVector2d unwrap(const Address& address);

/// A place in the hole that an opening leaves in the texture: −1 … 1 each way, within the circle.
Eigen::RowVector2d unwrap_hole(Sheet sheet, double side, const Eigen::Vector2d& place);

/// v of the strip `unit` row units below the cap; v falls from forehead to neck.
double strip_v(double unit);

/// The place a ring address starts from, in the square [−1, 1]² of its window: x outward, y up.
Eigen::Vector2d on_square(double around);
/// In that direction on the unit circle.
inline Eigen::Vector2d on_circle(double around) {
  const Eigen::Vector2d start = on_square(around);
  return start / start.norm();
}

}  // namespace crowdface::synth
