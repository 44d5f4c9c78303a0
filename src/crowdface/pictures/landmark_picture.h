// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/parts/surface_point.h"
#include "crowdface/pictures/crowd_renders.h"

namespace crowdface {

/// A point on a head, and the text beside the point in images.
struct LabelledPoint {
  std::string label;
  SurfacePoint surface_point;
};

/// Draws an image of a head with labelled points: all views of `renders` side by side. Returns the
/// bytes of a PNG file. Each view shows only the points on skin that faces its camera.
std::string landmark_picture(const CrowdRenders& renders, const Topology& topology,
                             const Positions& head, const std::vector<LabelledPoint>& points);

}  // namespace crowdface
