// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace crowdface {

/// Skin around eyes: to which lid it belongs. Empty where there is none.
struct LidSides {
  std::vector<signed char> side;  ///< #V: 1 of an upper lid, −1 of a lower one, else 0
  std::vector<float> off_rim;     ///< #V: how far from that lid's rim, at rest
};

}  // namespace crowdface
