// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/neck/open_rims.h"

namespace crowdface {

/// Finds the polygons of a body below a closed loop of edges: those connected with the lower side
/// of the loop, and those of separate parts whose middle is below the middle of the loop.
/// \param up  unit vector
/// \return  for each polygon, whether it is below the loop; all true if the loop is an open rim.
/// \throws InvalidInput if the loop does not separate the polygons along the loop.
std::vector<bool> polygons_below(const Topology& topology, const Positions& positions,
                                 const Rim& rim, const Eigen::Vector3d& up);

}  // namespace crowdface
