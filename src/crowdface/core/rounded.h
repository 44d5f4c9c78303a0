// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace crowdface {

/// As numbers stand in plans and reports: to a ten-thousandth.
inline double rounded(double value) {
  return std::round(value * 1e4) / 1e4;
}

}  // namespace crowdface
