// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/typical_head.h"

namespace crowdface {

/// Parameters for choosing colours (textures) at random, independently of shapes.
struct ColourOptions {
  std::uint64_t seed = 1;  ///< seed of the crowd's random numbers
  /// names of the heads; used to find a parent of a face if this parent is a head
  std::vector<std::string> head_names;
  HeadTags tags;  ///< the tags of each head, or empty
  /// The tags that must be equal on the head that lends colours and on the face's typical head.
  /// Empty optional: all tags.
  std::optional<std::vector<std::string>> tags_to_match;
};

/// Sets the colours, Recipe::colours, of each face. A head *matches* a face if the head's tags
/// match the tags of the face's typical head. The first rule that applies to a face determines its
/// colours:
///
/// 1. If the recipe already has colours, the face keeps them.
/// 2. If the face has parents, it gets the mean of both parents' colours, without the heads that do
///    not match the face. If no head remains, the next rule applies.
/// 3. All other faces get random colours: a mixture of two random heads among the heads that match
///    the face. The second head has a weight of at most one half.
///
/// The random numbers of a sampled face depend only on the face's index and attempt, those of a
/// member of a family only on the family's name, and those of any other face only on the face's id.
/// So the random colours of a face do not depend on other faces, and members of a family whose
/// typical heads have matching tags get the same random colours.
///
/// \param crowd  In the order of the plan: parents before children.
void choose_colours(const ColourOptions& options, std::vector<FacePlan>& crowd);

}  // namespace crowdface
