// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "head_models/synth/complexion.h"
#include "head_models/synth/hair.h"
#include "head_models/synth/noise.h"
#include "head_models/synth/relief.h"
#include "head_models/synth/skin_atlas.h"

namespace crowdface::synth {

/// Computes the skin colour and roughness of one person.
class SkinPaint {
 public:
  /// \param scalp_hair  opacity of hair painted on the scalp, 0 … 1; 1 if there is no other hair.
  SkinPaint(std::uint64_t seed, std::uint64_t index, double scalp_hair);

  /// Returns the colour at a place, sRGB.
  ScreenColour at(const SkinPlace& place) const;
  /// Returns the roughness at a place, 0 … 1.
  double roughness_at(const SkinPlace& place) const;

 private:
  using Vector = Eigen::Vector3d;

  ScreenColour eyeball(const Vector& ball) const;
  ScreenColour bare_skin(const Vector& p) const;
  void paint_spots(const Vector& p, ScreenColour& colour) const;
  void paint_lips(const SkinPlace& place, ScreenColour& colour) const;
  void paint_around_eyes(const SkinPlace& place, ScreenColour& colour) const;
  void paint_openings(const SkinPlace& place, ScreenColour& colour) const;
  void paint_beard(const Vector& p, ScreenColour& colour) const;
  double brow_cover(const Vector& p) const;
  double beard_cover(const Vector& p, double strand) const;
  double beard_length(const Vector& p) const;

  Person person_;
  Complexion look_;
  Relief relief_;
  SmoothNoise mottle_, blotch_, pores_, freckles_, spots_, hairs_, tufts_, hairline_;
  Hair hair_;
  double scalp_hair_;
};

}  // namespace crowdface::synth
