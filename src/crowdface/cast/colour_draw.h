// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/cast/typical_head.h"

namespace crowdface {

/// How colours are cast apart from shapes.
struct ColourDraw {
  std::uint64_t seed = 1;
  std::vector<std::string> heads;  ///< their names: parents may be heads
  HeadTags tags;                   ///< #heads, or none
  /// In which tags a face's colours must be like its shape: neither or both have each. Nothing: in all.
  std::optional<std::vector<std::string>> alike;
};

/// Gives each face colours of its own, Recipe::colours: those of one head, drawn evenly among the heads whose tags are like
/// those of the face's typical head, and up to half of a second one's. Drawn by the face's own index, or id if it is
/// not sampled, so that no other face matters. But a family has one complexion: a face of parents has half of
/// either's, as far as those heads are like itself, and whoever else is of a family has what is drawn for that.
/// What has colours already keeps them.
/// \param crowd  in the order of the plan: parents before children.
void draw_colours(const ColourDraw& draw, std::vector<CastFace>& crowd);

}  // namespace crowdface
