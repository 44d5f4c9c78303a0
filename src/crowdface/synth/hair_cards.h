// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/synth/complexion.h"

namespace crowdface::synth {

/// A way to wear hair, as it is cut and combed on the average head. Lengths in centimetres.
struct HairCut {
  std::string_view name;
  bool female = false;
  bool curly = false;
  double parting = 0;   ///< x of the line from which it is combed to both sides
  double sideways = 1;  ///< how strongly it is combed to the sides …
  double back = 0;      ///< … and back (below 0: forward)
  double length = 5;    ///< on top
  double sides = 5;     ///< above the ears and behind; 0: none grows there
  double hem = -30;     ///< it is cut at this height
  double fringe = 99;   ///< over the forehead it is cut here; 99: there is none
  double volume = 1;    ///< how far it stands off the scalp
  double wave = 0;      ///< how far locks swing to and fro
  int layers = 1;       ///< one above the other, each in directions of its own; 1: combed
};
std::span<const HairCut> hair_cuts();

/// Colours that hair in cards comes in.
struct HairColour {
  std::string_view name;
  ScreenColour colour;
};
std::span<const HairColour> hair_colours();
const HairColour& nearest_hair_colour(const ScreenColour& colour);

/// The hair in cards (narrow strips of quads, seen from both sides), as it sits on the average head.
/// Each card shows one quarter of hair_picture from its root (v = 1) to its tips. The same on every machine.
Mesh hair_cards(const HairCut& cut);

/// Strands side by side in four strips, their tips apart: size × size × 4 bytes (sRGB and alpha), row by row,
/// first row at v = 1.
std::vector<std::uint8_t> hair_picture(int size, const ScreenColour& colour, bool curly);

}  // namespace crowdface::synth
