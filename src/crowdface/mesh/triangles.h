// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Indices of three vertices.
using Triangle = std::array<std::uint32_t, 3>;

/// Cuts all polygons into fans of triangles around their first corners.
std::vector<Triangle> triangles_of(const Topology& topology);
/// Cuts the polygons of one component into triangles.
std::vector<Triangle> triangles_of(const Topology& topology, const Components& components,
                                   std::uint32_t component);

/// A topology whose polygons are the given triangles.
Topology topology_of(const std::vector<Triangle>& triangles, Index vertex_count);

/// The normal vector of a triangle, with twice the triangle's area as its length.
Eigen::Vector3d area_vector(const Positions& positions, const Triangle& triangle);

/// Barycentric coordinates of the point of a triangle that is nearest to p (Ericson 2005,
/// "Real-Time Collision Detection", §5.1.5).
std::array<double, 3> nearest_in_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                          const Eigen::Vector3d& c, const Eigen::Vector3d& p);

/// Unit normals of the vertices, #V by 3. Each unit normal is the normalised, area-weighted sum of
/// the normals of the triangles at the vertex. If the sum is zero or the vertex has no triangle,
/// the normal is zero; `vertex_normals` of a Topology returns (0, 0, 1) in these cases.
Positions vertex_normals_or_zero(const std::vector<Triangle>& triangles,
                                 const Positions& positions);

}  // namespace crowdface
