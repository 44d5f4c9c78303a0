// SPDX-License-Identifier: Apache-2.0
// Changed copies of a head: rotated, thinned, refined, noisy or cut; and how far the marks of their
// faces are from the marks of the head itself.
#pragma once

#include <string>
#include <vector>

#include "crowdface/paint/face_marks.h"

namespace crowdface::testing {

/// A mark on a changed copy of a head.
struct MarkError {
  std::string change;  ///< what was done to the copy
  std::string mark;
  bool is_found = false;
  double mm = 0;  ///< distance from the same mark on the head, along the axes of the face
};

/// Finds the face of a head and of its changed copies, all without eyeballs.
/// \param head  in centimetres, +Y up, +Z front; the eyes are about 7 cm in front of the origin
/// \return nothing if the head itself has no face
std::vector<MarkError> mark_errors(const Topology& topology, const HeadShape& head);

/// Moves and scales a head as `mark_errors` needs it. Returns false if it has no face.
bool put_at_origin(const Topology& topology, HeadShape& head);

}  // namespace crowdface::testing
