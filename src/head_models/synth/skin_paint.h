// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "head_models/synth/complexion.h"
#include "head_models/synth/hair.h"
#include "head_models/synth/noise.h"
#include "head_models/synth/relief.h"
#include "head_models/synth/skin_atlas.h"

namespace crowdface::synth {

/// Colours the skin of one person.
class SkinPaint {
 public:
  /// \param scalp_hair  how much of the hair's colour the scalp has where it grows: 1 all, as where it is all the hair
  ///                    that there is.
  SkinPaint(std::uint64_t seed, std::uint64_t index, double scalp_hair);

  ScreenColour at(const SkinPlace& place) const;
  /// 0 … 1.
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
