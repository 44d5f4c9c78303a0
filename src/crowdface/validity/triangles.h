// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/adjacency.h"

namespace crowdface {

/// Three vertices.
using Triangle = std::array<std::uint32_t, 3>;

/// The faces of one component, each cut into triangles from its first corner.
std::vector<Triangle> triangles_of(const Topology& topology, const Components& components,
                                   std::uint32_t component);

/// What a map from one mesh to another does to single triangles.
struct LocalDefects {
  Index flipped = 0;         ///< turned by more than a right angle
  Index collapsed = 0;       ///< left with less than the share of the area asked for
  double worst_stretch = 1;  ///< largest factor by which a length in a triangle grows
};

/// Compares the triangles of a face with those of its target. Triangles without area in the target
/// are passed over.
/// \param positions, target  #V by 3, in one frame.
LocalDefects local_defects(const std::vector<Triangle>& triangles, const Positions& positions,
                           const Positions& target, double least_area_share);

/// Whether two triangles pass through each other. Such as only touch, or lie in one plane, do not.
/// Source: Möller 1997, "A fast triangle-triangle intersection test".
bool triangles_intersect(const Positions& positions, const Triangle& a, const Triangle& b);

/// Whether they have a vertex in common.
bool share_vertex(const Triangle& a, const Triangle& b);

}  // namespace crowdface
