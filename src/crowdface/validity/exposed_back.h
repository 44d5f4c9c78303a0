// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "crowdface/validity/triangle_scene.h"

namespace crowdface {

/// Which triangles have a vertex in common with which.
class TriangleNeighbours {
 public:
  TriangleNeighbours(const std::vector<Triangle>& triangles, Index vertex_count);
  /// Those at a vertex, ascending.
  std::span<const std::uint32_t> around(std::uint32_t vertex) const;

 private:
  std::vector<std::uint32_t> offsets_;  ///< #V + 1
  std::vector<std::uint32_t> triangles_;
};

/// From where a face is looked at, and how large it is.
struct Viewing {
  std::vector<Eigen::Vector3d> directions;  ///< towards viewers, of any length but zero
  double mm_per_unit = 1;
};

/// How much of a skin shows its back to somebody who looks at it, in the positions' unit squared: where skin
/// passes through other skin, the lining of a nostril through its wing, say. Counted is what hangs
/// together with triangles that intersect others, at points a millimetre apart.
/// \param intersecting  pairs of triangles that pass through each other.
double exposed_back(const TriangleScene& scene, const std::vector<Triangle>& triangles,
                    const Positions& positions, const TriangleNeighbours& neighbours,
                    const std::vector<TrianglePair>& intersecting, const Viewing& viewing);

}  // namespace crowdface
