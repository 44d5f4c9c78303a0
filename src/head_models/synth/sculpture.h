// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace crowdface::synth {

/// Roughly the distance in centimetres from a point to the average head's skin, negative inside:
/// rounded bodies (skull, jaw, cheekbones, nose, lids, lips, neck) melted into one another.
/// Openings and ears are not part of it. Left and right are alike.
double skin_distance(const Eigen::Vector3d& point);

/// By how much a distance rises over two steps along each axis: along its gradient.
template <class Distance>
Eigen::Vector3d rise(const Distance& distance, const Eigen::Vector3d& point, double step) {
  Eigen::Vector3d rise;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d along = step * Eigen::Vector3d::Unit(k);
    rise[k] = distance(point + along) - distance(point - along);
  }
  return rise;
}

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
