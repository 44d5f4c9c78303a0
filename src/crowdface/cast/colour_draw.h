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
  std::uint64_t seed = 1;
  std::vector<std::string> heads;  ///< names of the heads; a parent may be a head
  HeadTags tags;                   ///< #heads, or empty
  /// Tags in which the head that lends colours must agree with the face's typical head. Empty
  /// optional: all tags.
  std::optional<std::vector<std::string>> tags_to_match;
};

/// Gives each face its own colours, Recipe::colours: a mixture of one random head (uniform among
/// the heads whose tags agree with the face's typical head) and of up to one half of a second such
/// head. Random numbers depend only on the face's index (or its id, if the face is not sampled), so
/// other faces do not change the colours. A family has one complexion: a face with parents gets
/// half of each parent's colours, without heads whose tags do not agree with the face; other
/// members share colours that are chosen for the family. Faces that already have colours keep
/// these.
///
/// \param crowd  In the order of the plan: parents before children.
void choose_colours(const ColourOptions& options, std::vector<FacePlan>& crowd);

}  // namespace crowdface
