// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "crowdface/cast/face_space.h"

namespace crowdface {

/// A face that is similar to another face, and the distance between both faces.
struct Neighbour {
  std::size_t face = 0;  ///< index of the similar face
  double distance_mm = 0;
};

/// For all faces of a crowd: which faces are similar to each other. These data do not depend on the
/// order in which the faces were cast.
struct Likeness {
  /// indices of all faces, in an order in which consecutive faces look alike
  std::vector<std::size_t> face_order;
  /// for each face: the nearest other faces, beginning with the nearest
  std::vector<std::vector<Neighbour>> neighbours;
};

/// Finds similar faces, and an order in which neighbours look alike. This order is a
/// nearest-neighbour walk: the walk starts at the face farthest from face 0, and always continues
/// with the nearest face that it has not visited. So two faces that are each other's nearest face
/// are adjacent. Of equally near faces, the walk takes the first.
///
/// \param neighbour_count  Number of neighbours to keep for each face.
/// \throws Interrupted.
Likeness find_likeness(const std::vector<FaceSpace::Point>& points, std::size_t neighbour_count);

}  // namespace crowdface
