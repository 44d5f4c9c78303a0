// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "head_models/synth/identity.h"

namespace crowdface::synth {

/// A colour as it is chosen on a screen (sRGB), each in [0, 1].
using ScreenColour = Eigen::Array3d;
inline ScreenColour from_bytes(double red, double green, double blue) {
  return ScreenColour(red, green, blue) / 255;
}
/// A part of one, 0 … 1, as a picture holds it.
inline std::uint8_t to_byte(double part) {
  return static_cast<std::uint8_t>(std::floor(255 * part + 0.5));
}

/// What a synthetic person's skin and hair look like.
struct Complexion {
  double tone = 0;         ///< 0 the lightest skin … 1 the darkest
  ScreenColour skin;       ///< where nothing else colours it
  ScreenColour hair;       ///< grey with the years
  ScreenColour brow_hair;  ///< of brows and beard, which go grey later
  double ruddy = 0;        ///< 0 … 1: how red cheeks, nose and ears are
  double freckles = 0;     ///< 0 … 1
  double age_spots = 0;    ///< 0 … 1
  double brows = 1;        ///< how dense they are
  double brow_width = 1;
  double brow_arch = 0;   ///< cm by which they rise further than a straight man's
  double beard = 0;       ///< on cheeks and jaw: 0 none, 0.15 shaven, 0.5 stubble, 1 a short beard
  double moustache = 0;   ///< the same on the upper lip …
  double chin_beard = 0;  ///< … and on the chin
  ScreenColour iris;
  double receding = 0;  ///< 0 a full hairline … 1 bald on top
  double made_up = 0;   ///< 0 … 1: colour on lips and lids, dark lashes
};

/// Of five successive women or men (from the heads 10k on) each has a tone of another fifth.
Complexion draw_complexion(std::uint64_t seed, std::uint64_t index);

}  // namespace crowdface::synth
