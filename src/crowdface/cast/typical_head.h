// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/blend/recipe.h"

namespace crowdface {

/// Tags of each head.
using HeadTags = std::vector<std::vector<std::string>>;

/// Whose tags a face has: its target's, and of a mixture those of the head in it with whose tags most of
/// the mixture agrees, so that one who is two thirds women's is a woman, whoever has the largest share.
/// Of equals the one with the largest share, of these the first.
Index typical_head(const Recipe& recipe, const HeadTags& tags);

}  // namespace crowdface
