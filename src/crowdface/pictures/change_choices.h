// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "crowdface/config/config.h"

namespace crowdface {

/// Adds to `json` what a page needs to offer changes of faces: `reviews`, the number of reviews of
/// the crowd; `hair_colours`, if attachments have a tint; `skins`, if the textures of heads are
/// blended.
void add_possible_changes(const Config& config, bool has_textures, nlohmann::ordered_json& json);

}  // namespace crowdface
