// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "head_models/synth/mean_head.h"

namespace crowdface::synth {

inline constexpr std::size_t kTexelsPerBlock = 4096;  ///< texels per parallel task

/// The location on the head that a texel of the texture shows.
struct SkinPlace {
  SkinPoint skin;    ///< on the average head
  double eye = 0;    ///< Address::b around an eye: 0 … 1 up to the edge of the lid, then up to 2
  double mouth = 0;  ///< Address::b around the mouth
  double nostril = 0;  ///< Address::b around a nostril
  double ball = 0;     ///< 1 on an eyeball
  Eigen::Vector3d on_ball =
      Eigen::Vector3d::Zero();  ///< on an eyeball: point on the unit sphere with its pupil at +z
  bool covered = false;         ///< whether the texel shows a surface
};

/// Returns size × size places, row by row, first row at v = 1. Texels that show no surface contain
/// the place of a near covered texel, so that colours continue beyond the edges of the texture
/// charts.
std::vector<SkinPlace> skin_atlas(int size);

}  // namespace crowdface::synth
