// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace crowdface {

/// 0 up to `from`, 1 from `to` on, in between the cubic 3t² − 2t³: a soft edge without libm.
inline double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// 1 at 0, 0 at 1, level at both (Tukey's biweight). \param x  0 … 1
inline double biweight(double x) {
  const double rest = 1 - x * x;
  return rest * rest;
}

}  // namespace crowdface
