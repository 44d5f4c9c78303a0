// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace crowdface {

/// How much a joint moves a vertex.
struct Influence {
  std::uint32_t joint;
  float weight;  ///< those of a vertex add up to one
};

}  // namespace crowdface
