// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "crowdface/core/parallel.h"
#include "head_models/synth/mean_head.h"

namespace crowdface::synth {

/// The point of the average head that one texel of the skin texture shows.
struct AtlasTexel {
  SkinPoint skin;  ///< the point on the average head
  /// Coordinate LatticePoint::b in the rings around an eye: 0 at their outline, 1 at the edge of
  /// the lid, 2 at the hole
  double eye_ring_coordinate = 0;
  /// Coordinate LatticePoint::b in the rings around the mouth: 1 at the edge of the opening between
  /// the lips
  double mouth_ring_coordinate = 0;
  /// Coordinate LatticePoint::b in the rings around a nostril: 1 at the edge of the nostril
  double nostril_ring_coordinate = 0;
  double on_eyeball = 0;  ///< 1 on an eyeball, 0 elsewhere
  Eigen::Vector3d point_on_ball =
      Eigen::Vector3d::Zero();   ///< on an eyeball: point on the unit sphere with its pupil at +z
  bool is_covered = false;       ///< whether the texel shows a surface
  std::size_t source_texel = 0;  ///< index of the covered texel from which this texel is copied
};

/// Returns size × size texels, row by row, first row at v = 1. A texel that shows no surface is a
/// copy of a nearby covered texel, so that colours continue beyond the edges of the texture charts.
std::vector<AtlasTexel> skin_atlas(int size);

/// Calls `body(i)` for all texels i of a size × size texture in parallel. Each parallel task has
/// one square of the texture, because SmoothNoise is fast for points that are close together.
template <class Body>
void for_each_texel(int size, const Body& body) {
  constexpr std::size_t kSide = 32;
  const auto width = static_cast<std::size_t>(size), squares = (width + kSide - 1) / kSide;
  parallel_for_each(squares * squares, 1, [&](std::size_t square) {
    const std::size_t left = square % squares * kSide, top = square / squares * kSide;
    for (std::size_t y = top; y < std::min(top + kSide, width); ++y) {
      for (std::size_t x = left; x < std::min(left + kSide, width); ++x) body(y * width + x);
    }
  });
}

}  // namespace crowdface::synth
