// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "crowdface/cast/sampling.h"

namespace crowdface {

/// Sampled faces that are drawn by numbers of their own.
struct Group {
  std::string name;
  std::optional<std::uint64_t> count;  ///< so many faces, before all that have a share
  double share = 0;                    ///< without a count: of the faces after those, 0 … 1
  SamplingOptions sampling;
};

}  // namespace crowdface
