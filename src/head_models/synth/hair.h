// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "head_models/synth/complexion.h"
#include "head_models/synth/noise.h"

namespace crowdface::synth {

/// A hair style. The thicknesses of the hair layer are in cm, before age-related thinning.
struct HairStyle {
  double top_thickness = 0;   ///< thickness above the forehead and on the crown
  double side_thickness = 0;  ///< thickness above and behind the ears
  double nape_length = 0;     ///< length of the hair that falls behind the ears and down the neck
  double bun_height = 0;      ///< height of a bun on top; 0: none
  double curliness = 0;       ///< 0 (straight) … 1 (tight curls)
  /// −1 … 1: additional volume of the top hair on one side; positive: on the side x > 0
  double extra_volume_to_side = 0;
  /// whether hair covers the temples and grows in front of the ears
  bool has_low_hairline = false;
};

/// Returns the height of a point above the hairline, cm; negative below.
/// \param has_low_hairline  whether the hairline is low, so that hair covers the temples.
/// \param recession  0 (full hairline) … 1 (bald); ignored if `has_low_hairline` is set.
double height_above_hairline(const Eigen::Vector3d& p, bool has_low_hairline, double recession = 0);

/// Returns whether a person's hair is curly.
bool has_curls(std::uint64_t seed, std::uint64_t index);

/// A person's hair as a layer on the scalp. All points are points of the average head, cm.
class Hair {
 public:
  /// \param includes_hanging_hair  whether the layer includes the hair that falls behind the ears
  ///                               and over the neck.
  Hair(std::uint64_t seed, std::uint64_t index, bool includes_hanging_hair = true);

  /// Returns whether hair may be at a point; a fast conservative test.
  bool may_cover(const Eigen::Vector3d& p) const;
  /// Returns how much brighter than the hair colour the strand at a point is: from about −1
  /// (darker) to about 1 (brighter).
  double strand_brightness(const Eigen::Vector3d& p) const;
  /// Returns the fraction of the skin that hair hides at a point, 0 … 1.
  /// \param strand_brightness  strand_brightness(p).
  double coverage(const Eigen::Vector3d& p, double strand_brightness) const;
  /// Returns the thickness of the hair layer at a point, cm.
  double thickness(const Eigen::Vector3d& p) const;

 private:
  /// Returns the height of a point above this person's hairline, cm; negative below. The hairline
  /// depends on the person's hair style and on the recession of the hair.
  double height_above_style_hairline(const Eigen::Vector3d& p) const {
    return height_above_hairline(p, style_.has_low_hairline, recession_);
  }
  /// Returns the density of the hair that remains after balding, 0 … 1; balding starts at the
  /// crown.
  double density_after_balding(const Eigen::Vector3d& p) const;
  /// Returns the amount, 0 … 1, of long hair that hangs over the neck at a point. Hanging hair
  /// starts behind the ears.
  double hanging_fraction(const Eigen::Vector3d& p) const;

  HairStyle style_;
  double recession_;  ///< see Complexion::recession
  /// Noise: brightness of single strands; brightness of tufts of strands.
  SmoothNoise hairs_, tufts_;
  SmoothNoise edge_;   ///< noise that makes the hairline irregular
  SmoothNoise locks_;  ///< noise that varies the thickness of curls and of hanging locks
};

}  // namespace crowdface::synth
