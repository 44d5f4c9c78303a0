// SPDX-License-Identifier: Apache-2.0
// Lists of heads, as the keys `targets` and `sources` name them.
#pragma once

#include <vector>

#include "crowdface/cast/sampling.h"
#include "crowdface/config/codec.h"

namespace crowdface {

/// Heads by name or tag; all of them for `all`. Ascending, each once.
Codec<std::vector<Eigen::Index>> head_list();
/// The same, or `{name: weight}`.
Codec<std::vector<WeightedHead>> weighted_heads();

}  // namespace crowdface
