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
  /// \param scalp_hair  1: all hair is painted. Below 1: hair, brows and beards are separate
  ///                    meshes; only hair roots are painted on the scalp, with this opacity and
  ///                    without hair colour.
  SkinPaint(std::uint64_t seed, std::uint64_t index, double scalp_hair)
      : SkinPaint(seed, index, scalp_hair, random_complexion(seed, index)) {}
  SkinPaint(std::uint64_t seed, std::uint64_t index, double scalp_hair,
            const Complexion& complexion);

  /// Returns the skin colour at a point of the head, sRGB.
  ScreenColour at(const AtlasTexel& place) const;
  /// Returns the roughness at a point of the head, 0 … 1.
  double roughness_at(const AtlasTexel& place) const;

  using Vector = Eigen::Vector3d;
  /// Returns the fraction of the skin that the brows hide at a point of the average head.
  double brow_coverage(const Vector& p) const;
  /// Returns the fraction of the skin that the beard hides at a point of the average head.
  double beard_coverage(const Vector& p) const;

 private:
  /// Returns the colour of an eyeball. \param ball  point on the unit sphere, pupil at +z.
  ScreenColour eyeball_colour(const Vector& ball) const;
  /// Returns the skin colour without spots, lips, make-up and hair.
  ScreenColour bare_skin_colour(const Vector& p) const;
  /// Paints freckles and age spots.
  void paint_spots(const Vector& p, ScreenColour& colour) const;
  void paint_lips(const AtlasTexel& place, ScreenColour& colour) const;
  void paint_around_eyes(const AtlasTexel& place, ScreenColour& colour) const;
  /// Paints the insides of mouth and nostrils dark red.
  void paint_openings(const AtlasTexel& place, ScreenColour& colour) const;
  void paint_beard(const Vector& p, ScreenColour& colour) const;
  /// Whether hair, brows and beard are painted on the skin instead of being separate meshes.
  bool paints_all_hair() const { return scalp_hair_ == 1; }
  /// Returns the fraction of the skin that single hairs of a brow hide.
  double brow_hairs(const Eigen::Vector2d& place, std::uint64_t side) const;
  /// Returns 1 in the area where a beard grows, 0 outside.
  /// \param strand  noise at `p`, −1 … 1, which frays the edge of the area.
  double beard_coverage(const Vector& p, double strand) const;
  /// Returns the length of the beard at a point, in the units of Complexion::beard.
  double beard_length(const Vector& p) const;

  Person person_;
  Complexion complexion_;
  Relief relief_;
  SmoothNoise mottle_, blotch_, pores_, freckles_, spots_, hairs_, tufts_, hairline_, grain_,
      flush_;
  double aged_;  ///< how aged the skin is: 0 up to 36 years of age, 1 from 68 years of age
  Hair hair_;
  double scalp_hair_;  ///< see the constructor
};

}  // namespace crowdface::synth
