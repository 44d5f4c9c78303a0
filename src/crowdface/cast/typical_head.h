// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/blend/recipe.h"

namespace crowdface {

/// Tags of each head.
using HeadTags = std::vector<std::vector<std::string>>;

/// Returns the head whose tags a face has. This is the target or, for a mixture, the head whose
/// tags agree with the largest part of the mixture: a mixture that is two thirds female is a woman,
/// even if the largest single weight is a man's. Ties are decided in favour of the larger weight,
/// then of the first head.
Index typical_head(const Recipe& recipe, const HeadTags& tags);

}  // namespace crowdface
