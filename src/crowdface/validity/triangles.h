// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// Defects of single triangles of a face compared with the target's triangles.
struct LocalDefects {
  Index compared_triangle_count = 0;  ///< number of triangles that are not degenerate in the target
  /// Number of triangles that are turned by more than 90° compared with the target. Also counts
  /// triangles whose area is less than 1/50 of the area of the target's triangle.
  Index flipped_triangle_count = 0;
  /// 99th percentile, over all triangles, of the triangle's largest stretch: the largest singular
  /// value of the linear map from the target's triangle to the face's triangle
  double stretch_factor = 1;
};

/// The triangles of a target, prepared for comparison with faces. A comparison counts flipped
/// triangles and computes a percentile of the stretch instead of the maximum, because scans have
/// sliver triangles that flip under any change.
class TargetTriangles {
 public:
  /// \param target  positions of the target, #V by 3.
  TargetTriangles(const std::vector<Triangle>& triangles, const Positions& target);
  /// Compares a face with the target.
  ///
  /// \param positions  #V by 3, in the same coordinate frame as the target.
  LocalDefects compare(const Positions& positions) const;
  std::uint64_t memory_bytes() const { return planar_triangles_.size() * sizeof(PlanarTriangle); }

 private:
  /// A triangle of the target, described by orthonormal coordinates in the triangle's plane: the
  /// corners are (0, 0), (length, 0) and (apex_x, apex_y).
  struct PlanarTriangle {
    Triangle corners;        ///< vertex indices
    Eigen::Vector3d normal;  ///< the length of this vector is twice the triangle's area
    double inverse_length, apex_x, inverse_apex_y;
  };
  /// the triangles of the target that are not degenerate
  std::vector<PlanarTriangle> planar_triangles_;
};

/// The positions of a triangle's corners.
using Corners = std::array<Eigen::Vector3d, 3>;
/// Returns the positions of a triangle's corners.
Corners corners_of(const Positions& positions, const Triangle& triangle);

/// Returns whether two triangles intersect. Triangles that only touch each other, and coplanar
/// triangles, do not count as intersecting. Source: Möller 1997, "A fast triangle-triangle
/// intersection test".
bool triangles_intersect(const Positions& positions, const Triangle& a, const Triangle& b);

/// Returns whether two triangles have a vertex in common.
inline bool share_vertex(const Triangle& a, const Triangle& b) {
  unsigned shared = 0;  // no branches, because the processor could not predict them
  for (const std::uint32_t vertex : a) {
    for (const std::uint32_t other : b) shared |= static_cast<unsigned>(vertex == other);
  }
  return shared != 0;
}

}  // namespace crowdface
