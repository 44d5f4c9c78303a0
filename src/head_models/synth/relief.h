// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include <Eigen/Geometry>

#include "head_models/synth/identity.h"
#include "head_models/synth/mean_head.h"
#include "head_models/synth/noise.h"

namespace crowdface::synth {

/// What lies on top of a head's shape: folds and lines that deepen with age, uneven skin, lip
/// creases and pores, each head's own.
class Relief {
 public:
  /// \param edge_cm  the mesh's usual edge length: relief that it cannot carry is left out.
  Relief(const Identity& identity, double edge_cm);

  /// Height above the average skin in centimetres, along its normal.
  double height(const SkinPoint& mean) const;

  /// The same of folds and lines alone, at a place of the average head.
  double folds(const Eigen::Vector3d& position) const;

 private:
  /// A curve drawn on the face from the front, pressed in (depth > 0) or raised.
  struct Stroke {
    static constexpr int kPieces = 12;
    std::array<Eigen::Vector2d, kPieces + 1> points;
    double width, depth, bulge;
    double lane = 0, length = 0;  ///< where it is broken; length 0: nowhere
    Eigen::AlignedBox2d reach;    ///< where it has any effect
  };
  double grain(const Eigen::Vector3d& position) const;
  double press(const Stroke& stroke, const Eigen::Vector2d& place) const;
  void add_stroke(std::size_t which, double side, double depth);

  std::vector<Stroke> strokes_;
  SmoothNoise waver_x_, waver_y_, wander_, breaks_;
  struct Octave {
    SmoothNoise noise;
    double amplitude;
  };
  std::vector<Octave> broad_, fine_;
  SmoothNoise lip_creases_;
  double lip_depth_;
};

}  // namespace crowdface::synth
