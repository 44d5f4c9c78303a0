// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "head_models/synth/lattice.h"

namespace crowdface::synth {

/// A line from inside the head through a point near the skin; where it meets the skin, the mesh
/// has its vertex.
struct GuideRay {
  Eigen::Vector3d origin, guide;
};

/// Rays for strip and cap: a smooth web through hand-placed points of a lattice.
GuideRay strip_ray(double a, double b);
GuideRay cap_ray(double a, double b);

/// The strip ray where a window's ring address starts (side x > 0).
GuideRay window_ray(const Window& window, double around);

}  // namespace crowdface::synth
