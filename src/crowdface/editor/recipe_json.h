// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "crowdface/cast/draw_recipe.h"
#include "crowdface/config/config.h"

namespace crowdface {

/// The recipe as an entry of the config's `recipes`, every region spelled out. Beside it stands
/// `mixture: {head: share}`, which no config has, where the target is one.
nlohmann::ordered_json recipe_to_json(const CastFace& face, const Casting& casting,
                                      const Config& config);

/// The face of an entry that recipe_to_json wrote, or anybody. Ages of the config are left out: a
/// recipe that gives none is not moved.
/// \throws UsageError with every mistake, in the config's own words.
CastFace face_of_json(const nlohmann::ordered_json& recipe, const Casting& casting,
                      const Config& config);

/// The entry as the config's own section takes it, for a config to keep.
/// \throws UsageError as above, or for a mixture.
HandRecipe hand_recipe_of_json(const nlohmann::ordered_json& recipe, const Config& config);

}  // namespace crowdface
