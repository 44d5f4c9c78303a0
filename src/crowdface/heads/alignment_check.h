// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// How a head stands against the reference head.
struct HeadPose {
  double angle_degrees = 0;  ///< rotation that carries it onto the reference
  double shift = 0;          ///< distance of the heads' middles, as a fraction of the head's size
  double scale = 1;          ///< its size relative to the reference
};

/// Poses of all heads against the one that stands most like all others; skin vertices only.
std::vector<HeadPose> head_poses(const FaceSet& faces, const Components& components);

/// Warnings about heads that are turned, moved or scaled against the others, which would enter as
/// detail. `check`: as found; `rigid`: heads are moved onto the first head first.
/// \throws InvalidInput if a head is in another unit, or (`check`) turned by more than 45 degrees.
std::vector<std::string> align_heads(FaceSet& faces, const Components& components, Align align);

}  // namespace crowdface
