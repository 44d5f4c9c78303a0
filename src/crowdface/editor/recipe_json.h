// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "crowdface/cast/draw_recipe.h"
#include "crowdface/config/config.h"

namespace crowdface {

/// The recipe as an entry of the config's `recipes`, with all regions written out. If the target is
/// a mixture of heads, the entry also has `mixture: {head: share}`, which a config must not have.
nlohmann::ordered_json recipe_to_json(const FacePlan& face, const CastingOptions& casting,
                                      const Config& config);

/// Reads a face from an entry that recipe_to_json or a user wrote. Ignores the ages of the config:
/// a recipe without an age keeps its shape.
/// \throws UsageError with all mistakes, in the words of the config's messages.
FacePlan face_of_json(const nlohmann::ordered_json& recipe, const CastingOptions& casting,
                      const Config& config);

/// Converts the entry for saving in a config's `recipes` section.
/// \throws UsageError as face_of_json does, and for a mixture.
ManualRecipe manual_recipe_of_json(const nlohmann::ordered_json& recipe, const Config& config);

}  // namespace crowdface
