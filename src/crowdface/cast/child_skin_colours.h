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

/// Parameters for choosing the skin colours of faces with parents.
struct ChildSkinOptions {
  std::uint64_t seed = 1;               ///< seed of the crowd's random numbers
  std::vector<std::string> head_names;  ///< names of the heads, because a parent may be a head
  HeadTags tags;                        ///< the tags of each head, or empty
  /// tone of each head: the mean optical density of the head's colour texture
  std::vector<double> tones;
  /// Returns one weight per head: the head's share in a face's colours. The weights sum to one.
  std::function<std::vector<double>(const Recipe&)> colour_weights;
  /// names of the families whose members are twins; twins share one tone
  std::set<std::string> twin_families = {};
};

/// Gives each face with parents its own colours, Recipe::colours. The tone of the face's skin is a
/// random tone between the parents' tones, at a fraction from 0.3 to 0.7 of the way. The colours
/// are a mixture of two heads with this tone. Of all such mixtures, the function chooses the
/// mixture that differs least from the face's typical head in sex and age, then the mixture whose
/// heads have the most similar tones. A face keeps the colours that it already has if their tone
/// lies in this range.
///
/// \param crowd  In the order of the plan: parents before children.
void choose_skin_colours_of_children(const ChildSkinOptions& options, std::vector<FacePlan>& crowd);

}  // namespace crowdface
