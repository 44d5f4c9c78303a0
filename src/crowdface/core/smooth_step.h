// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace crowdface {

/// Smooth step: 0 for x ≤ from, 1 for x ≥ to, else 3t² − 2t³ with t = (x − from) / (to − from).
/// Needs no libm.
inline double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Tukey's biweight (1 − x²)²: 1 at x = 0 and 0 at x = 1, with slope 0 at both ends. \param x in
/// [0, 1].
inline double biweight(double x) {
  const double rest = 1 - x * x;
  return rest * rest;
}

}  // namespace crowdface
