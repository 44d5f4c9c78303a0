// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace crowdface::synth {

/// Returns the approximate signed distance in cm from a point to the skin of the average head,
/// negative inside: a smooth union of round bodies (skull, jaw, cheekbones, nose, lids, lips,
/// neck). Openings and ears are not included. The head is symmetric.
double skin_distance(const Eigen::Vector3d& point);

/// Returns the y coordinate in cm of the line between the lips of the average head. The line is
/// lowest in the middle and 0.7 mm higher at the corners of the mouth, because a face with low
/// corners looks sad.
double lip_line(double x);
/// half the width of the mouth, cm
inline constexpr double kMouthHalfWidth = 2.45;

/// Returns the central differences of a distance function, 2 · step · gradient.
template <class Distance>
Eigen::Vector3d central_differences(const Distance& distance, const Eigen::Vector3d& point,
                                    double step) {
  Eigen::Vector3d differences;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d along = step * Eigen::Vector3d::Unit(k);
    differences[k] = distance(point + along) - distance(point - along);
  }
  return differences;
}

/// Returns the unit normal of the skin at a point on or near the skin.
Eigen::Vector3d skin_normal(const Eigen::Vector3d& point);

/// Intersects the line from `origin` through `point_near_skin` with the skin. Returns the
/// intersection nearest to `point_near_skin`.
Eigen::Vector3d project_onto_skin(const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& point_near_skin);

/// Centre of the eyeball at x > 0, cm. The eyeball is larger than a real eyeball, because only its
/// front is visible.
inline Eigen::Vector3d eye_centre() {
  return {3.12, 0, 6.75};
}
inline constexpr double kEyeRadius = 1.70;  ///< radius of the average head's eyeballs, cm

}  // namespace crowdface::synth
