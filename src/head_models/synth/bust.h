// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"

namespace crowdface::synth {

/// Returns a bust below a neck: shoulders and chest without arms, open at top and bottom. The
/// texture shows the bust from above, with the front at the bottom of the image.
/// \param rim  the points at the lower end of the neck of the average head, in cm, one row for each
///             point, counter-clockwise seen from above. The points of the rim are also the first
///             vertices of the result.
Mesh bust_below(const Positions& rim);

/// Returns the point, in cm, that an ideal bust has at the given texture coordinates. Coordinates
/// outside the bust give a point on its edge.
Eigen::Vector3d bust_point(const Eigen::RowVector2d& uv);

}  // namespace crowdface::synth
