// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "crowdface/cast/draw_recipe.h"
#include "crowdface/config/config.h"

namespace crowdface {

/// Converts the recipe of a face to JSON, in the format of an entry of the config's `recipes`. The
/// entry lists all regions. If the target is a mixture of heads, the entry also has `mixture:
/// {head: share}`, which a config must not have.
nlohmann::ordered_json recipe_to_json(const FacePlan& face, const CastingOptions& casting,
                                      const Config& config);

/// Reads a face from JSON that recipe_to_json or a user wrote, in the format of an entry of the
/// config's `recipes`. If the entry has no age, the shape of the face is not aged, even if the
/// config samples ages.
/// \throws UsageError that lists all mistakes, with the same texts as for mistakes in a config.
FacePlan face_of_json(const nlohmann::ordered_json& recipe, const CastingOptions& casting,
                      const Config& config);

/// Converts JSON in the format of an entry of the config's `recipes` to the recipe that the config
/// would contain.
/// \throws UsageError as face_of_json does, and also if the JSON has a `mixture`, because a config
/// cannot contain a target that is a mixture of heads.
ManualRecipe manual_recipe_of_json(const nlohmann::ordered_json& recipe, const Config& config);

}  // namespace crowdface
