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

/// Parameters for choosing the skin colours of children.
struct SkinOptions {
  std::uint64_t seed = 1;
  std::vector<std::string> heads;  ///< names of the heads; a parent may be a head
  HeadTags tags;                   ///< #heads
  std::vector<double> tones;       ///< #heads: mean optical density of the colour textures
  /// Weights of the heads in a face's colours, #heads; they sum to one.
  std::function<std::vector<double>(const Recipe&)> colour_weights;
  std::set<std::string> twins = {};  ///< families whose members are twins with the same tone
};

/// Gives each face with parents its own colours, Recipe::colours, so that the tone of its skin lies
/// between the tones of its parents, at a random fraction from 0.2 to 0.8. The colours are a
/// mixture of two heads: the next lighter and the next darker head with the sex and the age class
/// of the face. If all such heads are lighter or all are darker, the nearest head alone lends its
/// colours. Faces that already have colours keep these.
///
/// \param crowd  In the order of the plan: parents before children.
void choose_skin_colours_of_children(const SkinOptions& options, std::vector<FacePlan>& crowd);

}  // namespace crowdface
