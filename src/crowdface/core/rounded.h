// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace crowdface {

/// Rounds to four decimals, the precision of numbers in plans and reports.
inline double rounded(double value) {
  return std::round(value * 1e4) / 1e4;
}

}  // namespace crowdface
