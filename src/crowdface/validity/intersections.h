// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/validity/triangle_scene.h"
#include "crowdface/validity/triangles.h"

namespace crowdface {

/// Returns the pairs of triangles whose bounding boxes overlap after each box has grown by `margin`
/// on all sides; see TriangleScene::near_pairs.
std::vector<TrianglePair> near_pairs(const std::vector<Triangle>& triangles,
                                     const Positions& positions, double margin);

/// Returns the entries of `pairs` whose two triangles intersect each other; see
/// triangles_intersect.
std::vector<TrianglePair> intersecting_pairs(const std::vector<Triangle>& triangles,
                                             const Positions& positions,
                                             const std::vector<TrianglePair>& pairs);

/// Counts the triangles of a face that take part in intersections that the face's target does not
/// have. The target is the head on which the face is built.
/// Where the target already intersects itself (for example at the corner of the mouth), the face's
/// triangles next to this intersection may intersect too. Therefore a pair of triangles is ignored
/// if both triangles share a vertex with triangles that intersect other triangles in the target.
class NewIntersections {
 public:
  /// \param target_pairs  all pairs of triangles that intersect in the target.
  NewIntersections(const std::vector<Triangle>& triangles, Index vertex_count,
                   const std::vector<TrianglePair>& target_pairs);
  /// Returns the number of triangles that take part in new intersections.
  ///
  /// \param face_pairs  all pairs of triangles that intersect in the face.
  Index count(const std::vector<TrianglePair>& face_pairs) const;

 private:
  /// for each triangle, whether it shares a vertex with a triangle that intersects another triangle
  /// in the target
  std::vector<bool> near_target_intersection_;
};

}  // namespace crowdface
