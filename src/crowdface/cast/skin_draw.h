// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/typical_head.h"

namespace crowdface {

/// Parameters for the skin of children.
struct SkinDraw {
  std::uint64_t seed = 1;
  std::vector<std::string> heads;  ///< names of the heads, because parents may be heads
  HeadTags tags;                   ///< #heads
  std::vector<double> tones;       ///< #heads: mean density of the skin's pigments
  /// Weights of the heads in a face's colours, #heads; they sum to one.
  std::function<std::vector<double>(const Recipe&)> shares;
  std::set<std::string> twins = {};  ///< families whose members are twins, of one tone
};

/// Gives each face with parents its own colours, Recipe::colours, so that the tone of its skin lies
/// between the tones of its parents: a random place between 0.2 and 0.8 of the way. The colours are
/// a mixture of two heads, the next lighter and the next darker one among the heads with the sex and
/// the age class of the face. If all these heads are lighter or all are darker, the nearest head
/// lends its colours alone. Faces that already have colours keep them.
///
/// \param crowd  In the order of the plan: parents before children.
void draw_skin_of_children(const SkinDraw& draw, std::vector<FacePlan>& crowd);

}  // namespace crowdface
