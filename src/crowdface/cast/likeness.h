// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "crowdface/cast/face_space.h"

namespace crowdface {

/// Another face and how far it is.
struct Neighbour {
  std::size_t face = 0;
  double mm = 0;
};

/// Who looks like whom in a whole crowd, whatever the order it was cast in.
struct Likeness {
  std::vector<std::size_t> order;            ///< faces, so that neighbours look alike
  std::vector<std::vector<Neighbour>> near;  ///< of each face the nearest others, nearest first
};

/// The order is a walk that always goes on to the nearest face that is left, from the face farthest
/// from the first: two faces that are each other's nearest always stand side by side. Of equally near
/// faces the first counts. \throws Interrupted.
/// \param neighbours  how many to keep for each face.
Likeness find_likeness(const std::vector<FaceSpace::Point>& points, std::size_t neighbours);

}  // namespace crowdface
