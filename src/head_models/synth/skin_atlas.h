// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "head_models/synth/mean_head.h"

namespace crowdface::synth {

inline constexpr std::size_t kTexelsPerBlock = 4096;  ///< that a thread works on at a time

/// What of the skin a texel of the texture shows.
struct SkinPlace {
  SkinPoint skin;  ///< on the average head
  double eye = 0;  ///< ring address around an eye: 0 … 1 up to the lid's edge, beyond it 1 … 2
  double mouth = 0;    ///< the same around the mouth
  double nostril = 0;  ///< and around a nostril
  double ball = 0;     ///< 1 on an eyeball, which the skin surrounds
  Eigen::Vector3d on_ball =
      Eigen::Vector3d::Zero();  ///< there: the place on the unit ball, looking along +z
  bool covered = false;         ///< whether any surface is shown here
};

/// size × size places, row by row, first row at v = 1. Those that show no skin hold the place of the nearest
/// covered texel that was found, so that colours run on beyond the skin's edges.
std::vector<SkinPlace> skin_atlas(int size);

}  // namespace crowdface::synth
