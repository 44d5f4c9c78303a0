// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/landmark_names.h"

#include <algorithm>
#include <array>
#include <utility>

#include "crowdface/traits/measurements.h"

namespace crowdface {

const std::vector<LandmarkDefinition>& suggested_landmarks() {
  static const std::vector<LandmarkDefinition> names = [] {
    std::vector<LandmarkDefinition> all = {
        {"eye_outer_left", "outer corner of the head's own left eye", true},
        {"eye_outer_right", "outer corner of the right eye", true},
        {"nose_tip", "the foremost point of the nose", true},
        {"chin", "the foremost point of the chin, in the middle", true},
        {"mouth_left", "corner of the mouth on the head's own left", true},
        {"mouth_right", "corner of the mouth on the right", true},
        {"eye_inner_left", "inner corner of the left eye", true},
        {"eye_inner_right", "inner corner of the right eye", true},
        {"nose_base", "where the nose's underside meets the upper lip, in the middle", true},
        {"nose_bridge", "the deepest point between the eyes, in the middle", true},
        {"lip_upper", "the foremost point of the upper lip, in the middle", true},
        {"lip_lower", "the foremost point of the lower lip, in the middle", true},
        {"nose_wing_left", "the outermost point of the left wing of the nose"},
        {"nose_wing_right", "the outermost point of the right wing of the nose"},
        {"lid_upper_left", "the middle of the left upper lid's edge", true},
        {"lid_upper_right", "the middle of the right upper lid's edge", true},
        {"lid_lower_left", "the middle of the left lower lid's edge", true},
        {"lid_lower_right", "the middle of the right lower lid's edge", true},
        {"brow_left", "the outer end of the left brow, on the bone"},
        {"brow_right", "the outer end of the right brow, on the bone"},
        {"ear_lobe_left", "where the left ear's lobe meets the cheek"},
        {"ear_lobe_right", "where the right ear's lobe meets the cheek"},
        {"ear_top_left", "where the left ear's upper rim meets the head"},
        {"ear_top_right", "where the right ear's upper rim meets the head"}};
    for (const TraitLandmark& of_traits : trait_landmarks()) {
      if (std::ranges::find(all, of_traits.name, &LandmarkDefinition::name) == all.end()) {
        all.push_back({of_traits.name, of_traits.location});
      }
    }
    return all;
  }();
  return names;
}

std::optional<std::string> mirrored_name(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kSides = {
      {{"left", "right"}, {"l", "r"}, {"L", "R"}, {"Left", "Right"}}};
  const std::size_t cut = name.find_last_of("_-. ");
  const std::size_t begin = cut == std::string_view::npos ? 0 : cut + 1;
  for (const auto& [left, right] : kSides) {
    for (const auto& [from, to] : {std::pair(left, right), std::pair(right, left)}) {
      if (name.substr(begin) == from) return std::string(name.substr(0, begin)).append(to);
    }
  }
  return std::nullopt;
}

}  // namespace crowdface
