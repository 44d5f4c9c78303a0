// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Three vertices.
using Triangle = std::array<std::uint32_t, 3>;

/// All faces, each cut into triangles from its first corner.
std::vector<Triangle> triangles_of(const Topology& topology);
/// The same of the faces of one component.
std::vector<Triangle> triangles_of(const Topology& topology, const Components& components,
                                   std::uint32_t component);

/// Triangles as faces.
Topology topology_of(const std::vector<Triangle>& triangles, Index vertex_count);

/// Along the triangle's normal, as long as twice its area.
Eigen::Vector3d area_vector(const Positions& positions, const Triangle& triangle);

/// Barycentric coordinates of the point of a triangle nearest to p (Ericson 2005, "Real-Time
/// Collision Detection", §5.1.5).
std::array<double, 3> nearest_in_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                          const Eigen::Vector3d& c, const Eigen::Vector3d& p);

/// Unit normals of the vertices, #V by 3, each the sum of the normals around it weighted by area; zero
/// where the sum vanishes, and at vertices of no triangle. (`vertex_normals` of a Topology has (0, 0, 1) there.)
Positions vertex_normals_or_zero(const std::vector<Triangle>& triangles,
                                 const Positions& positions);

}  // namespace crowdface
