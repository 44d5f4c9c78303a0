// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace crowdface::synth {

/// Roughly the distance in centimetres from a point to the average head's skin, negative inside:
/// rounded bodies (skull, jaw, cheekbones, nose, lids, lips, neck) melted into one another.
/// Openings and ears are not part of it. Left and right are alike.
double skin_distance(const Eigen::Vector3d& point);

/// Unit normal of the skin at a point on or near it.
Eigen::Vector3d skin_normal(const Eigen::Vector3d& point);

/// Where the line from `origin` through `guide` meets the skin, at the crossing nearest to `guide`.
Eigen::Vector3d onto_skin(const Eigen::Vector3d& origin, const Eigen::Vector3d& guide);

/// The ball behind the lids: larger than an eye, as only its front shows.
inline Eigen::Vector3d eye_centre() {
  return {3.12, 0, 6.75};
}
inline constexpr double kEyeRadius = 1.70;

}  // namespace crowdface::synth
