// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "head_models/synth/lattice.h"

namespace crowdface::synth {

/// Returns the texture coordinates of a lattice point in the tile [0, 1]². The layout has no
/// overlaps. The texture seam is at the back of the head. The skin patch on top of the head
/// (SkinPatch::kCap) is attached to the forehead.
Eigen::RowVector2d unwrap(const LatticePoint& lattice_point);

/// Returns the texture coordinates (u, v) of a point in the hole that an opening leaves in the
/// texture.
/// \param side   1, or −1 for the opening at x < 0.
/// \param place  point in the unit disc; the disc maps to the hole.
Eigen::RowVector2d unwrap_hole(SkinPatch patch, double side, const Eigen::Vector2d& place);

/// Returns texture coordinates in the texture area of an eyeball. This area is a disc, large enough
/// that the pupil is round in a texture of 1,024 texels.
/// \param side   1, or −1 for the eyeball at x < 0.
/// \param place  point in the unit disc; the disc maps to the texture area.
Eigen::RowVector2d unwrap_eyeball(double side, const Eigen::Vector2d& place);

/// Returns the point of the unit disc that unwrap_eyeball maps to the given texture coordinates.
/// For the eyeball at x < 0, the returned point is mirrored (x negated). Coordinates outside the
/// texture areas of the eyeballs give a point outside the unit disc.
Eigen::Vector2d eyeball_disc_point(const Eigen::RowVector2d& uv);

/// Returns the texture coordinate v of the strip (SkinPatch) at a distance below the cap; v
/// decreases from forehead to neck.
/// \param units_below_cap  the second coordinate of a LatticePoint on the strip.
double strip_v(double units_below_cap);

/// Maps a ring coordinate (0 … 4, one unit per side) to the point on the outline of the square
/// [−1, 1]². The x axis points away from the symmetry plane of the face, and the y axis up. 0 is
/// the upper corner next to the symmetry plane, and 1 the corner below it.
Eigen::Vector2d point_on_square(double around);
/// Returns the point of the unit circle in the direction of point_on_square(around).
inline Eigen::Vector2d point_on_circle(double around) {
  const Eigen::Vector2d start = point_on_square(around);
  return start / start.norm();
}

}  // namespace crowdface::synth
