// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

namespace crowdface {

/// Returns the value at x of the piecewise linear function through the knots, which are sorted by
/// ascending x. Beyond the first and last knot the function is constant.
/// \param knots  at least one
inline double interpolate_knots(std::span<const Eigen::Vector2d> knots, double x) {
  if (x <= knots.front().x()) return knots.front().y();
  for (std::size_t i = 1; i < knots.size(); ++i) {
    if (x > knots[i].x()) continue;
    const double t = (x - knots[i - 1].x()) / (knots[i].x() - knots[i - 1].x());
    return knots[i - 1].y() + t * (knots[i].y() - knots[i - 1].y());
  }
  return knots.back().y();
}

}  // namespace crowdface
