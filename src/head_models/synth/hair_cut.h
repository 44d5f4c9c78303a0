// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

#include "head_models/synth/complexion.h"

namespace crowdface::synth {

/// A haircut: how hair is cut and combed on the average head. Lengths are in cm.
struct HairCut {
  static constexpr double kNoFringe = 99;  ///< value of fringe_y for a cut without a fringe

  std::string_view name;
  bool is_for_women = false;
  bool is_curly = false;
  bool has_bald_crown = false;  ///< whether the crown is bald
  double recession = 0;  ///< hairline recession, 0 … 1; above 0, the cut is not for young people
  double parting_x = 0;  ///< x coordinate of the parting on the average head, cm
  double sideways_combing = 1;  ///< component of the combing direction away from the parting
  double backward_combing = 0;  ///< backward component of the combing direction
  double top_length = 5;        ///< length of the hair on top of the head, cm
  double side_length = 5;  ///< length of the hair above and behind the ears, cm; 0: no hair there
  double hem_y = -30;      ///< y coordinate of the haircut's lower edge, at which hair is cut, cm
  double fringe_y = kNoFringe;  ///< y coordinate of the fringe's lower edge, or kNoFringe
  double volume_factor = 1;     ///< factor on the distance of the hair from the scalp
  double wave_amplitude = 0;    ///< amplitude of waves in the locks
  /// number of layers of hair; 1: combed locks, above 1: curls with random directions
  int layers = 1;
  /// whether the hair is tied at the back; in front of the tie, the hair lies on the head
  bool is_tied = false;
  bool excludes_old_people = false;  ///< whether the cut is not for old people

  bool has_fringe() const { return fringe_y < kNoFringe; }
  bool has_parting() const { return layers == 1 && backward_combing < 0.8 && !has_fringe(); }
  /// Whether the longest hair is longer than 10 cm.
  bool is_long() const { return std::max(top_length, side_length) > 10; }
};
/// Returns all haircuts.
std::span<const HairCut> hair_cuts();

/// A hair colour that hair cards may have.
struct HairColour {
  std::string_view name;
  ScreenColour colour;
};
/// Returns the natural hair colours, without grey.
std::span<const HairColour> hair_colours();
/// Returns the most similar colour of hair_colours().
const HairColour& nearest_hair_colour(const ScreenColour& colour);

}  // namespace crowdface::synth
