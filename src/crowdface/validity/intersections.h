// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/validity/triangle_scene.h"
#include "crowdface/validity/triangles.h"

namespace crowdface {

/// Pairs of triangles whose boxes, grown by `margin` on all sides, overlap, see TriangleScene.
std::vector<TrianglePair> near_pairs(const std::vector<Triangle>& triangles,
                                     const Positions& positions, double margin);

/// Those of the pairs that pass through each other.
std::vector<TrianglePair> intersecting(const std::vector<Triangle>& triangles,
                                       const Positions& positions,
                                       const std::vector<TrianglePair>& pairs);

/// How many triangles of a face take part in intersections that its target has not. Where the target
/// intersects itself already, at the corner of a mouth, say, the next triangles may too: pairs that
/// both touch a vertex there are not counted.
class NewIntersections {
 public:
  /// \param target_pairs  the target's own intersecting pairs.
  NewIntersections(const std::vector<Triangle>& triangles, Index vertex_count,
                   const std::vector<TrianglePair>& target_pairs);
  Index count(const std::vector<TrianglePair>& face_pairs) const;

 private:
  std::vector<bool> excused_;  ///< #T: touches a triangle that intersects another in the target
};

}  // namespace crowdface
