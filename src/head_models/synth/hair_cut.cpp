// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/hair_cut.h"

#include <algorithm>
#include <array>

namespace crowdface::synth {

std::span<const HairCut> hair_cuts() {
  // clang-format off
  static const std::array cuts = {
      HairCut{.name = "long", .is_for_women = true, .parting_x = 0.4, .backward_combing = 0.35,
              .top_length = 30, .side_length = 18, .hem_y = -17, .volume_factor = 0.9,
              .wave_amplitude = 0.05, .excludes_old_people = true},
      HairCut{.name = "side_swept", .is_for_women = true, .parting_x = 2.8,
              .backward_combing = 0.35, .top_length = 27, .side_length = 17, .hem_y = -16,
              .volume_factor = 1.25, .wave_amplitude = 0.16},
      HairCut{.name = "bob", .is_for_women = true, .parting_x = -2.2, .backward_combing = 0.2,
              .top_length = 19, .side_length = 10, .hem_y = -8.5, .volume_factor = 1.1,
              .wave_amplitude = 0.06},
      HairCut{.name = "fringe", .is_for_women = true, .backward_combing = 0.3, .top_length = 24,
              .side_length = 14, .hem_y = -12, .fringe_y = 3.4, .volume_factor = 0.9,
              .wave_amplitude = 0.05, .excludes_old_people = true},
      HairCut{.name = "tied_back", .is_for_women = true, .sideways_combing = 0.3,
              .backward_combing = 1, .top_length = 15, .side_length = 11, .hem_y = -3.5,
              .volume_factor = 0.7, .wave_amplitude = 0.04, .is_tied = true},
      HairCut{.name = "pixie", .is_for_women = true, .parting_x = 2.4, .backward_combing = 0.25,
              .top_length = 9, .side_length = 4.5, .hem_y = -1, .wave_amplitude = 0.08},
      HairCut{.name = "waves", .is_for_women = true, .is_curly = true, .parting_x = 1.5,
              .backward_combing = 0.3, .top_length = 26, .side_length = 16, .hem_y = -14,
              .volume_factor = 1.3, .wave_amplitude = 0.28},
      HairCut{.name = "curly_bob", .is_for_women = true, .is_curly = true, .parting_x = -1.6,
              .backward_combing = 0.2, .top_length = 18, .side_length = 10, .hem_y = -7,
              .volume_factor = 1.4, .wave_amplitude = 0.3},
      HairCut{.name = "curls", .is_for_women = true, .is_curly = true, .top_length = 2,
              .side_length = 2, .volume_factor = 3, .layers = 4},
      HairCut{.name = "long_curls", .is_for_women = true, .is_curly = true, .parting_x = -0.5,
              .backward_combing = 0.4, .top_length = 28, .side_length = 17, .hem_y = -16,
              .volume_factor = 1.1, .wave_amplitude = 0.2},
      HairCut{.name = "side_parting", .parting_x = -3.2, .backward_combing = 0.35,
              .top_length = 9, .side_length = 1.6, .hem_y = 1, .volume_factor = 1.1,
              .wave_amplitude = 0.1},
      HairCut{.name = "middle_parting", .parting_x = 0.3, .backward_combing = 0.35,
              .top_length = 13, .side_length = 6.5, .hem_y = -2, .volume_factor = 1.5,
              .wave_amplitude = 0.2, .excludes_old_people = true},
      HairCut{.name = "swept_back", .sideways_combing = 0.25, .backward_combing = 1,
              .top_length = 9, .side_length = 3, .hem_y = 0, .wave_amplitude = 0.05, .excludes_old_people = true},
      HairCut{.name = "tousled", .parting_x = 1.5, .sideways_combing = 0.6,
              .backward_combing = -0.3, .top_length = 4.5, .side_length = 2, .hem_y = 1,
              .fringe_y = 5.6, .wave_amplitude = 0.25, .excludes_old_people = true},
      HairCut{.name = "crew", .sideways_combing = 0.3, .backward_combing = -0.8, .top_length = 1.8,
              .side_length = 1.2, .hem_y = 0.5, .fringe_y = 6.4, .volume_factor = 0.8,
              .wave_amplitude = 0.1, .excludes_old_people = true},
      HairCut{.name = "waved_back", .is_curly = true, .sideways_combing = 0.3,
              .backward_combing = 1, .top_length = 9, .side_length = 3, .hem_y = 0,
              .volume_factor = 1.2, .wave_amplitude = 0.35, .excludes_old_people = true},
      HairCut{.name = "curly_top", .is_curly = true, .top_length = 2.0, .side_length = 0,
              .volume_factor = 2.4, .layers = 4, .excludes_old_people = true},
      HairCut{.name = "short_curls", .is_curly = true, .top_length = 1.2, .side_length = 0,
              .volume_factor = 1.4, .layers = 3},
      HairCut{.name = "receding_back", .recession = 0.4, .sideways_combing = 0.25,
              .backward_combing = 1, .top_length = 7, .side_length = 2.5, .hem_y = 0,
              .volume_factor = 0.8, .wave_amplitude = 0.05},
      HairCut{.name = "receding_crop", .recession = 0.55, .sideways_combing = 0.4,
              .backward_combing = 0.8, .top_length = 1.6, .side_length = 1, .hem_y = 0.5,
              .volume_factor = 0.5},
      HairCut{.name = "receding_curls", .is_curly = true, .recession = 0.45, .top_length = 1.1,
              .side_length = 0, .volume_factor = 1.1, .layers = 3},
      HairCut{.name = "ring", .has_bald_crown = true, .sideways_combing = 0.4,
              .backward_combing = 0.8, .top_length = 2.6, .side_length = 2.6, .hem_y = -3,
              .volume_factor = 0.7, .wave_amplitude = 0.12},
      HairCut{.name = "cropped_ring", .has_bald_crown = true, .sideways_combing = 0.4,
              .backward_combing = 0.8, .top_length = 1.4, .side_length = 1.4, .hem_y = -2,
              .volume_factor = 0.25, .wave_amplitude = 0.06},
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
