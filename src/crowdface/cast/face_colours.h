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
  std::uint64_t seed = 1;               ///< seed of the crowd's random numbers
  std::vector<std::string> head_names;  ///< names of the heads, because a parent may be a head
  HeadTags tags;                        ///< the tags of each head, or empty
  /// The tags that must be equal on the head that lends colours and on the face's typical head.
  /// Empty optional: all tags.
  std::optional<std::vector<std::string>> tags_to_match;
};

/// Sets each face's own colours, Recipe::colours. The colours are a mixture of two random heads;
/// the second head has a weight of at most one half. Both heads are drawn uniformly from the heads
/// whose tags match the tags of the face's typical head. The random numbers of a sampled face
/// depend only on the face's index and attempt. The random numbers of a face that is neither
/// sampled nor a member of a family depend only on the face's id. So the colours of these faces do
/// not depend on any other face.
///
/// A face with parents gets half of each parent's colours, without the heads whose tags do not
/// match the tags of the face's typical head. If no head is left, or if a family has no parents,
/// the members get random colours. The random numbers then depend only on the family's name, so
/// members whose typical heads have matching tags get the same colours. Faces that already have
/// colours keep their colours.
///
/// \param crowd  In the order of the plan: parents before children.
void choose_colours(const ColourOptions& options, std::vector<FacePlan>& crowd);

}  // namespace crowdface
