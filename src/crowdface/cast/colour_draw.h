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
  std::vector<std::string> heads;  ///< names of the heads, because parents may be heads
  HeadTags tags;                   ///< #heads, or empty
  /// Tags in which the head that lends colours must agree with the face's typical head. Empty
  /// optional: all tags.
  std::optional<std::vector<std::string>> alike;
};

/// Gives each face its own colours, Recipe::colours: a mixture of one head, drawn evenly among the
/// heads whose tags agree with the face's typical head, and of up to one half of a second such
/// head. Random numbers depend only on the face's index (or its id, if the face is not sampled), so
/// other faces do not change them. A family has one complexion: a face with parents gets half of
/// each parent's colours, without heads whose tags do not agree with the face; other members get
/// the colours drawn for the family. Faces that already have colours keep them.
///
/// \param crowd  In the order of the plan: parents before children.
void draw_colours(const ColourDraw& draw, std::vector<FacePlan>& crowd);

}  // namespace crowdface
