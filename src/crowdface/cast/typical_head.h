// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/blend/recipe.h"

namespace crowdface {

/// The tags of each head, #heads.
using HeadTags = std::vector<std::vector<std::string>>;

/// Returns the head whose tags a face has: the target or, for a mixture, the head whose tags agree
/// with the largest part of the mixture. A mixture that is two thirds female has a woman's tags,
/// even if the largest single weight belongs to a man. Ties are decided in favour of the larger
/// weight, then of the first head.
Index typical_head(const Recipe& recipe, const HeadTags& tags);

}  // namespace crowdface
