// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "crowdface/validity/triangles.h"

namespace crowdface {

/// Two triangles by their numbers, the smaller first.
using TrianglePair = std::pair<std::uint32_t, std::uint32_t>;

/// Pairs of triangles without a common vertex whose boxes, grown by `margin` on all sides, overlap;
/// ascending. The broad phase is Embree's (rtcCollide). Triangles at a vertex of more than a thousand
/// are left out.
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
