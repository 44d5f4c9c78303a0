// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// Defects of single triangles of a face compared with the target's triangles.
struct LocalDefects {
  Index compared = 0;  ///< triangles that are not degenerate in the target
  Index flipped = 0;   ///< triangles turned by more than 90° or shrunk below 1/50 of their area
  double stretch = 1;  ///< 99th percentile of the largest stretch of a triangle (factor on lengths)
};

/// The triangles of a target, prepared for comparison with faces. Defects are reported as counts
/// and a percentile, not as maxima, because scans have sliver triangles that flip under any change.
class TargetTriangles {
 public:
  /// \param target  #V by 3.
  TargetTriangles(const std::vector<Triangle>& triangles, const Positions& target);
  /// \param positions  #V by 3, in the same coordinate frame as the target.
  LocalDefects compare(const Positions& positions) const;
  std::uint64_t memory_bytes() const { return frames_.size() * sizeof(Frame); }

 private:
  /// A target triangle in orthonormal coordinates of its plane, with corners (0, 0), (length, 0),
  /// (shift, height).
  struct Frame {
    Triangle corners;
    Eigen::Vector3d normal;  ///< length: twice the area
    double length, shift, height;
  };
  std::vector<Frame> frames_;  ///< the non-degenerate triangles
};

/// The positions of a triangle's corners.
using Corners = std::array<Eigen::Vector3d, 3>;
/// Returns the positions of a triangle's corners.
Corners corners_of(const Positions& positions, const Triangle& triangle);

/// Whether two triangles intersect. Triangles that only touch, and coplanar triangles, do not
/// count. Source: Möller 1997, "A fast triangle-triangle intersection test".
bool triangles_intersect(const Positions& positions, const Triangle& a, const Triangle& b);

/// Whether two triangles have a vertex in common.
inline bool share_vertex(const Triangle& a, const Triangle& b) {
  unsigned shared = 0;  // no branches: they would be unpredictable
  for (const std::uint32_t vertex : a) {
    for (const std::uint32_t other : b) shared |= static_cast<unsigned>(vertex == other);
  }
  return shared != 0;
}

}  // namespace crowdface
