// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/neck/open_rims.h"

namespace crowdface {

/// Finds the polygons of a body below a closed loop of edges. A polygon is below the loop if it is
/// connected with the lower side of the loop. A part that does not touch the loop is below the loop
/// if the mean height of its polygons is less than the mean height of the loop.
/// \param rim  the loop, as vertices in order
/// \param up   unit vector
/// \return  for each polygon, whether it is below the loop. If the loop is a border of the mesh
///          (only one polygon at each edge), all polygons count as below.
/// \throws InvalidInput if the loop does not separate the polygons along the loop.
std::vector<bool> polygons_below(const Topology& topology, const Positions& positions,
                                 const Rim& rim, const Eigen::Vector3d& up);

}  // namespace crowdface
