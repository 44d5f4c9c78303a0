// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

namespace crowdface::synth {

/// Returns the value at x of the piecewise linear function through the knots, which are sorted by
/// ascending x. Beyond the first and last knot the function is constant.
template <std::size_t N>
double interpolate_knots(const std::array<Eigen::Vector2d, N>& knots, double x) {
  if (x <= knots[0].x()) return knots[0].y();
  for (std::size_t i = 1; i < N; ++i) {
    if (x > knots[i].x()) continue;
    const double t = (x - knots[i - 1].x()) / (knots[i].x() - knots[i - 1].x());
    return knots[i - 1].y() + t * (knots[i].y() - knots[i - 1].y());
  }
  return knots[N - 1].y();
}

}  // namespace crowdface::synth
