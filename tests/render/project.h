// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/render/camera.h"

namespace crowdface::testing {

/// Where a point appears, as fractions of the image's side, (0, 0) the upper left corner.
inline Eigen::Vector2d project(const Camera& camera, const Eigen::Vector3d& point) {
  const Eigen::Vector3d relative = point - camera.position();
  const double scale = 0.5 / (camera.tan_half_fov * -relative.dot(camera.back));
  return {0.5 + scale * relative.dot(camera.right), 0.5 - scale * relative.dot(camera.up)};
}

}  // namespace crowdface::testing
