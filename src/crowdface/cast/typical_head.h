// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/blend/recipe.h"

namespace crowdface {

/// For each head, the head's tags.
using HeadTags = std::vector<std::vector<std::string>>;

/// Returns the head whose tags apply to a face: the target or, if the target is a mixture, the head
/// whose tags agree with the largest part of the mixture. A mixture that is two thirds female has a
/// woman's tags, even if the largest single weight belongs to a man. Of equally suitable heads, the
/// head with the larger weight is chosen, then the first head.
Index typical_head(const Recipe& recipe, const HeadTags& tags);

}  // namespace crowdface
