// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/change_choices.h"

#include <algorithm>

#include "crowdface/cast/hair_colour.h"
#include "crowdface/cast/review.h"

namespace crowdface {

void add_possible_changes(const Config& config, bool has_textures, nlohmann::ordered_json& json) {
  if (!config.review.reviews.empty()) json["reviews"] = config.review.reviews.size();
  if (std::ranges::any_of(config.attachments.items,
                          [](const auto& item) { return item.tint != Tint::kNone; })) {
    for (const NamedHairColour& colour : named_hair_colours()) {
      json["hair_colours"].push_back(colour.name);
    }
  }
  if (has_textures && config.textures.blend == TextureBlend::kAuto) json["skins"] = true;
}

}  // namespace crowdface
