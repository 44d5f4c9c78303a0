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
  std::vector<std::string> head_names;  ///< names of the heads, because a parent may be a head
  HeadTags tags;                        ///< the tags of each head, or empty
  /// tone of each head: the mean optical density of the head's colour texture
  std::vector<double> tones;
  /// Returns one weight per head: the head's share in a face's colours. The weights sum to one.
  std::function<std::vector<double>(const Recipe&)> colour_weights;
  /// names of the families whose members are twins; twins share one tone
  std::set<std::string> twin_families = {};
};

/// Gives each face with parents its own colours, Recipe::colours. The tone of the face's skin then
/// lies between the tones of its parents, at a random fraction from 0.3 to 0.7. The colours are a
/// mixture of two heads that gives this tone with the least possible skin of another sex or age
/// class; among equal mixtures, the heads with the most similar tones are taken. Colours that the
/// face already has stay if their tone lies in this range.
///
/// \param crowd  In the order of the plan: parents before children.
void choose_skin_colours_of_children(const SkinOptions& options, std::vector<FacePlan>& crowd);

}  // namespace crowdface
