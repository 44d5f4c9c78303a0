// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// What a map from one mesh to another does to single triangles.
struct LocalDefects {
  Index compared = 0;  ///< triangles that have an area in the target
  Index flipped = 0;   ///< turned by more than a right angle, or left with a fiftieth of their area
  double stretch = 1;  ///< factor by which lengths grow that all but one in a hundred stay below
};

/// The triangles of a target, ready to be compared with those of faces. Scans have slivers that any
/// change turns over, so counts and a percentile tell more than the worst.
class TargetTriangles {
 public:
  /// \param target  #V by 3.
  TargetTriangles(const std::vector<Triangle>& triangles, const Positions& target);
  /// \param positions  #V by 3, in the same frame.
  LocalDefects compare(const Positions& positions) const;
  std::uint64_t memory_bytes() const { return frames_.size() * sizeof(Frame); }

 private:
  /// A triangle in an orthonormal frame of its plane: (0, 0), (length, 0), (shift, height).
  struct Frame {
    Triangle corners;
    Eigen::Vector3d normal;  ///< as long as twice the area
    double length, shift, height;
  };
  std::vector<Frame> frames_;  ///< of those with an area
};

/// Where the corners of a triangle are.
using Corners = std::array<Eigen::Vector3d, 3>;
Corners corners_of(const Positions& positions, const Triangle& triangle);

/// Whether two triangles pass through each other. Such as only touch, or lie in one plane, do not.
/// Source: Möller 1997, "A fast triangle-triangle intersection test".
bool triangles_intersect(const Positions& positions, const Triangle& a, const Triangle& b);

/// Whether they have a vertex in common.
inline bool share_vertex(const Triangle& a, const Triangle& b) {
  unsigned shared = 0;  // without branches, which no processor foresees here
  for (const std::uint32_t vertex : a) {
    for (const std::uint32_t other : b) shared |= static_cast<unsigned>(vertex == other);
  }
  return shared != 0;
}

}  // namespace crowdface
