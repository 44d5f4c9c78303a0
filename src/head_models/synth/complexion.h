// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "head_models/synth/identity.h"

namespace crowdface::synth {

/// An sRGB colour; components in [0, 1].
using ScreenColour = Eigen::Array3d;
/// Converts the components of an sRGB colour from the range 0 … 255 to the range 0 … 1.
inline ScreenColour from_bytes(double red, double green, double blue) {
  return ScreenColour(red, green, blue) / 255;
}
/// Maps a value in [0, 1] to an integer in 0 … 255, rounded to the nearest integer.
inline std::uint8_t to_byte(double value) {
  return static_cast<std::uint8_t>(std::floor(255 * value + 0.5));
}

/// Colours and hair growth of a synthetic person.
struct Complexion {
  double skin_tone = 0;     ///< 0 (lightest skin) … 1 (darkest)
  ScreenColour skin;        ///< base colour of the skin
  ScreenColour young_hair;  ///< colour of the scalp hair in young years
  ScreenColour hair;        ///< colour of the scalp hair, including grey
  ScreenColour brow_hair;   ///< colour of brows and beard; turns grey later than `hair`
  double redness = 0;       ///< 0 … 1: redness of cheeks, nose and ears
  double freckles = 0;      ///< 0 … 1: amount of freckles
  double age_spots = 0;     ///< 0 … 1: amount of age spots
  double brow_density = 1;  ///< factor on the density of the hairs of the brows
  double brow_width = 1;    ///< factor on the thickness of the brows
  double brow_arch = 0;     ///< additional height of the brows' arch in cm; 0 for men
  double beard = 0;  ///< hair on cheeks and jaw: 0 none, 0.12 shaven, 0.45 stubble, 1 short beard
  double moustache = 0;   ///< hair on the upper lip, on the same scale as `beard`
  double chin_beard = 0;  ///< hair on the chin, on the same scale as `beard`
  ScreenColour iris;      ///< mean colour of the iris
  double recession = 0;   ///< recession of the hairline: 0 (full) … 1 (bald on top)
  double makeup = 0;      ///< 0 … 1: make-up on lids, lashes and cheeks
  double lipstick = 0;    ///< 0 … 1: amount of lipstick; 0 for most people
};

/// Returns the random complexion of head `index`. Skin tones are stratified. Of ten successive
/// heads (10 · n to 10 · n + 9, for any n), five are women, whose tones lie in different fifths of
/// the range; the same holds for the five men.
Complexion random_complexion(std::uint64_t seed, std::uint64_t index);

}  // namespace crowdface::synth
