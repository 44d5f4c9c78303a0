// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/typical_head.h"

namespace crowdface {

/// Parameters for drawing colours (textures) independently of shapes.
struct ColourDraw {
  std::uint64_t seed = 1;
  std::vector<std::string> heads;  ///< names of the heads: parents may be heads
  HeadTags tags;                   ///< #heads, or empty
  /// Tags on which the head that lends colours and the face's typical head must agree. Empty
  /// optional: all tags.
  std::optional<std::vector<std::string>> alike;
};

/// Gives each face its own colours, Recipe::colours. They are a mixture of one head, drawn evenly
/// among the heads that agree with the face's typical head in their tags, and up to one half of a
/// second such head. Random numbers depend on the face's index (or id, if it is not sampled) only,
/// so other faces do not change them. A family shares one complexion: a face with parents gets half
/// of each parent's colours, as far as those heads agree with its own tags; other members get the
/// colours drawn for the family. Faces that already have colours keep them.
///
/// \param crowd  In the order of the plan: parents before children.
void draw_colours(const ColourDraw& draw, std::vector<FacePlan>& crowd);

}  // namespace crowdface
