// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "head_models/synth/complexion.h"

namespace crowdface::synth {

/// A way to wear hair, as it is cut and combed on the average head. Lengths in centimetres.
struct HairCut {
  std::string_view name;
  bool female = false;
  bool curly = false;
  bool crown_bald = false;  ///< it grows around a bald crown
  double parting = 0;       ///< x of the line from which it is combed to both sides
  double sideways = 1;      ///< how strongly it is combed to the sides …
  double back = 0;          ///< … and back (below 0: forward)
  double length = 5;        ///< on top
  double sides = 5;         ///< above the ears and behind; 0: none grows there
  double hem = -30;         ///< it is cut at this height
  double fringe = 99;       ///< over the forehead it is cut here; 99: there is none
  double volume = 1;        ///< how far it stands off the scalp
  double wave = 0;          ///< how far locks swing to and fro
  int layers = 1;           ///< one above the other, each in directions of its own; 1: combed
  bool tied = false;        ///< held on the head until it is behind the ears

  bool has_fringe() const { return fringe < 99; }
};
std::span<const HairCut> hair_cuts();

/// Colours that hair in cards comes in.
struct HairColour {
  std::string_view name;
  ScreenColour colour;
};
std::span<const HairColour> hair_colours();
const HairColour& nearest_hair_colour(const ScreenColour& colour);

}  // namespace crowdface::synth
