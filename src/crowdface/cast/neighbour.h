// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace crowdface {

/// Another face and how far it is.
struct Neighbour {
  std::size_t face = 0;
  double mm = 0;
};

}  // namespace crowdface
