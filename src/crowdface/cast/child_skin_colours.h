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
  std::uint64_t seed = 1;  ///< seed of the crowd's random numbers
  /// names of the heads; used to find a parent of a face if this parent is a head
  std::vector<std::string> head_names;
  HeadTags tags;  ///< the tags of each head, or empty
  /// tone of each head: the mean optical density of the head's colour texture
  std::vector<double> tones;
  /// Returns one weight per head: the head's share in a face's colours. The weights sum to one.
  std::function<std::vector<double>(const Recipe&)> colour_weights;
  /// names of the families whose members are twins; twins share one tone
  std::set<std::string> twin_families = {};
};

/// Gives each face with parents its own colours, Recipe::colours. If the face already has colours,
/// and their skin tone lies at a fraction from 0.3 to 0.7 of the way between the parents' tones,
/// the face keeps these colours. Otherwise a random tone in this range is drawn, and the face gets
/// the colours of two heads, mixed so that the mixture has this tone. Of all such mixtures, the
/// function chooses the mixture whose heads differ least in sex and age from the face's typical
/// head (see typical_head); of equally good mixtures, the mixture whose two heads have the most
/// similar tones.
///
/// \param crowd  In the order of the plan: parents before children.
void choose_skin_colours_of_children(const ChildSkinOptions& options, std::vector<FacePlan>& crowd);

}  // namespace crowdface
