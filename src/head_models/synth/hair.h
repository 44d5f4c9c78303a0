// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "head_models/synth/complexion.h"
#include "head_models/synth/noise.h"

namespace crowdface::synth {

/// How somebody wears their hair: as thick as this, in centimetres, before it thins out with the years.
struct HairStyle {
  double top = 0;         ///< above the forehead and on the crown
  double sides = 0;       ///< above the ears and behind
  double nape = 0;        ///< hair that falls behind the ears and down the neck
  double bun = 0;         ///< a knot on top, its height
  double curls = 0;       ///< 0 straight … 1 tight curls
  double lean = 0;        ///< −1 … 1: how much fuller one side of the top is
  bool low_edge = false;  ///< it covers the temples, and runs down before the ears
};

/// Centimetres above the hairline. \param low_edge  as women's: it covers the temples.
double above_hairline(const Eigen::Vector3d& p, bool low_edge, double receding = 0);

/// Whether somebody's hair is curly rather than straight.
bool has_curls(std::uint64_t seed, std::uint64_t index);

/// The hair on the head of one person, as a layer of the scalp. Points are the average head's.
class Hair {
 public:
  Hair(std::uint64_t seed, std::uint64_t index);

  /// Whether any hair may be here.
  bool reaches(const Eigen::Vector3d& p) const;
  /// How light the hair is here against its own colour, about −1 … 1.
  double strand(const Eigen::Vector3d& p) const;
  /// How much of the skin it hides, 0 … 1, by the strand that is here.
  double cover(const Eigen::Vector3d& p, double strand) const;
  /// How far it stands off the scalp, in centimetres.
  double thickness(const Eigen::Vector3d& p) const;

 private:
  double above_edge(const Eigen::Vector3d& p) const {
    return above_hairline(p, style_.low_edge, receding_);
  }
  double thinned(const Eigen::Vector3d& p) const;
  double falling(const Eigen::Vector3d& p) const;

  HairStyle style_;
  double receding_;
  SmoothNoise hairs_, tufts_, edge_, locks_;
};

}  // namespace crowdface::synth
