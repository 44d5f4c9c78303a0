// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "head_models/synth/lattice.h"

namespace crowdface::synth {

/// A line from a point inside the head through a point near the skin, cm. The point where the line
/// intersects the skin is a vertex of the mesh.
struct GuideRay {
  Eigen::Vector3d origin, point_near_skin;
};

/// Returns the ray for a point of the skin patch SkinPatch::kStrip, which surrounds the head. The
/// ray is interpolated smoothly between hand-placed rays at the lattice's rows and columns.
/// \param a, b  coordinates of the point, see LatticePoint
GuideRay strip_ray(double a, double b);
/// Returns the ray for a lattice point (a, b) of the cap, the skin patch on top of the head.
GuideRay cap_ray(double a, double b);

/// Returns the ray of a point on the outline (ring coordinate b = 0) of the opening at x > 0.
/// \param around  ring coordinate a, 0 … 4.
GuideRay opening_ray(const Opening& opening, double around);

}  // namespace crowdface::synth
