// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/hair_cut.h"

#include <algorithm>
#include <array>

namespace crowdface::synth {

std::span<const HairCut> hair_cuts() {
  // clang-format off
  static const std::array cuts = {
      HairCut{.name = "long", .female = true, .parting = 0.4, .back = 0.35, .length = 30, .sides = 18, .hem = -17,
              .volume = 0.9, .wave = 0.05, .young = true},
      HairCut{.name = "side_swept", .female = true, .parting = -3.0, .back = 0.25, .length = 26, .sides = 16, .hem = -14,
              .volume = 1.5, .wave = 0.15},
      HairCut{.name = "bob", .female = true, .parting = -2.2, .back = 0.2, .length = 19, .sides = 10, .hem = -8.5,
              .volume = 1.1, .wave = 0.06},
      HairCut{.name = "fringe", .female = true, .back = 0.3, .length = 24, .sides = 14, .hem = -12, .fringe = 3.4,
              .volume = 0.9, .wave = 0.05, .young = true},
      HairCut{.name = "tied_back", .female = true, .sideways = 0.3, .back = 1, .length = 15, .sides = 11, .hem = -3.5,
              .volume = 0.7, .wave = 0.04, .is_tied = true},
      HairCut{.name = "pixie", .female = true, .parting = 2.4, .back = 0.25, .length = 9, .sides = 4.5, .hem = -1,
              .wave = 0.08},
      HairCut{.name = "waves", .female = true, .curly = true, .parting = 1.5, .back = 0.3, .length = 26, .sides = 16,
              .hem = -14, .volume = 1.7, .wave = 0.35, .young = true},
      HairCut{.name = "curly_bob", .female = true, .curly = true, .parting = -2.4, .back = 0.2, .length = 18, .sides = 10,
              .hem = -7, .volume = 2.1, .wave = 0.45},
      HairCut{.name = "curls", .female = true, .curly = true, .length = 1.7, .sides = 1.6, .volume = 2.1, .layers = 4},
      HairCut{.name = "cropped_curls", .female = true, .curly = true, .length = 1.1, .sides = 0.8, .volume = 1.1, .layers = 3},
      HairCut{.name = "side_parting", .parting = -3.2, .back = 0.35, .length = 8.5, .sides = 2.6, .hem = 0.5,
              .volume = 0.9, .wave = 0.05},
      HairCut{.name = "middle_parting", .parting = 0.3, .back = 0.1, .length = 9.5, .sides = 4, .hem = 0.5,
              .volume = 1.3, .wave = 0.12, .young = true},
      HairCut{.name = "swept_back", .sideways = 0.25, .back = 1, .length = 9, .sides = 3, .hem = 0, .wave = 0.05},
      HairCut{.name = "tousled", .parting = 1.5, .sideways = 0.6, .back = -0.3, .length = 4.5, .sides = 2, .hem = 1,
              .fringe = 5.6, .wave = 0.25, .young = true},
      HairCut{.name = "crew", .sideways = 0.3, .back = -0.8, .length = 1.8, .sides = 1.2, .hem = 0.5, .fringe = 6.4,
              .volume = 0.8, .wave = 0.1},
      HairCut{.name = "waved_back", .curly = true, .sideways = 0.3, .back = 1, .length = 9, .sides = 3, .hem = 0,
              .volume = 1.2, .wave = 0.35},
      HairCut{.name = "curly_top", .curly = true, .length = 2.0, .sides = 0, .volume = 2.4, .layers = 4, .young = true},
      HairCut{.name = "short_curls", .curly = true, .length = 1.2, .sides = 0, .volume = 1.4, .layers = 3},
      HairCut{.name = "receding_back", .receding = 0.4, .sideways = 0.25, .back = 1, .length = 7, .sides = 2.5, .hem = 0,
              .volume = 0.8, .wave = 0.05},
      HairCut{.name = "receding_crop", .receding = 0.55, .sideways = 0.4, .back = 0.8, .length = 1.6, .sides = 1,
              .hem = 0.5, .volume = 0.5},
      HairCut{.name = "receding_curls", .curly = true, .receding = 0.45, .length = 1.1, .sides = 0, .volume = 1.1,
              .layers = 3},
      HairCut{.name = "ring", .has_bald_crown = true, .sideways = 0.4, .back = 0.8, .length = 4, .sides = 4, .hem = -3,
              .volume = 1.6, .wave = 0.2},
      HairCut{.name = "cropped_ring", .has_bald_crown = true, .sideways = 0.4, .back = 0.8, .length = 1.2, .sides = 1.2,
              .hem = -2, .volume = 0.4},
  };
  // clang-format on
  return cuts;
}

std::span<const HairColour> hair_colours() {
  static const std::array colours = {
      HairColour{"blond", from_bytes(170, 138, 96)},
      HairColour{"light_brown", from_bytes(120, 92, 66)},
      HairColour{"brown", from_bytes(80, 60, 47)},
      HairColour{"dark_brown", from_bytes(55, 42, 35)},
      HairColour{"black", from_bytes(32, 28, 27)},
  };
  return colours;
}

const HairColour& nearest_hair_colour(const ScreenColour& colour) {
  const auto off = [&](const HairColour& other) { return (other.colour - colour).square().sum(); };
  return *std::ranges::min_element(hair_colours(), {}, off);
}

}  // namespace crowdface::synth
