// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/blend/recipe.h"

namespace crowdface {

/// Tags of each head.
using HeadTags = std::vector<std::vector<std::string>>;

/// Returns the head whose tags a face has: the target, or for a mixture the head whose tags agree
/// with most of the mixture. So a mixture that is two thirds female is a woman, even if the largest
/// single share is a man's. Of equally good heads, the one with the largest share; then the first.
Index typical_head(const Recipe& recipe, const HeadTags& tags);

}  // namespace crowdface
