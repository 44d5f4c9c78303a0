// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace crowdface {

/// Smooth step: 0 for x ≤ low, 1 for x ≥ high, else 3t² − 2t³ with t = (x − low) / (high − low).
/// Uses no function of the C math library.
inline double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Tukey's biweight (1 − x²)²: 1 at x = 0 and 0 at x = 1, with slope 0 at both ends. \param x in
/// [0, 1].
inline double biweight(double x) {
  const double one_minus_square = 1 - x * x;
  return one_minus_square * one_minus_square;
}

}  // namespace crowdface
