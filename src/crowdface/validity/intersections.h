// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/validity/triangle_scene.h"
#include "crowdface/validity/triangles.h"

namespace crowdface {

/// Pairs of triangles whose bounding boxes, grown by `margin` on all sides, overlap; see
/// TriangleScene::near_pairs.
std::vector<TrianglePair> near_pairs(const std::vector<Triangle>& triangles,
                                     const Positions& positions, double margin);

/// The given pairs that intersect, see triangles_intersect.
std::vector<TrianglePair> intersecting(const std::vector<Triangle>& triangles,
                                       const Positions& positions,
                                       const std::vector<TrianglePair>& pairs);

/// Counts the triangles of a face that take part in intersections that the target does not have.
/// Where the target already intersects itself, for example at the corner of the mouth, adjacent
/// triangles may intersect too: a pair is ignored if both its triangles share a vertex with
/// triangles that intersect in the target.
class NewIntersections {
 public:
  /// \param target_pairs  the intersecting pairs of the target itself.
  NewIntersections(const std::vector<Triangle>& triangles, Index vertex_count,
                   const std::vector<TrianglePair>& target_pairs);
  /// The number of triangles in new intersections.
  /// \param face_pairs  all intersecting pairs of the face.
  Index count(const std::vector<TrianglePair>& face_pairs) const;

 private:
  /// #T: whether the triangle shares a vertex with one that intersects in the target.
  std::vector<bool> excused_;
};

}  // namespace crowdface
