// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "crowdface/mesh/triangles.h"
#include "crowdface/parts/point_grid.h"

namespace crowdface {

/// A point on a triangle of a mesh. Larger polygons are triangulated as fans from their first
/// corner.
struct SurfacePoint {
  Triangle corners = {};                               ///< vertex indices of the triangle
  std::array<double, 3> barycentric = {};              ///< barycentric coordinates
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< position of the point
  double distance = 0;                                 ///< distance from the query point
};

/// Returns the point with these barycentric coordinates on a triangle.
Eigen::Vector3d point_on(const Positions& positions, const Triangle& corners,
                         const std::array<double, 3>& barycentric);

/// Returns the point of the surface that is nearest to `point`. Considers only the polygons around
/// a vertex and around the neighbours of this vertex.
SurfacePoint nearest_point_around(const Topology& topology, const VertexFaces& faces,
                                  const Positions& positions, std::uint32_t vertex,
                                  const Eigen::Vector3d& point);

/// Walks over the mesh from vertex `start` as long as a vertex of an adjacent polygon is nearer to
/// the point than the current vertex. Returns the last vertex, which is a good start for
/// nearest_point_from. This walk is cheaper than nearest_point_from.
std::uint32_t walk_to_nearest_vertex(const Topology& topology, const VertexFaces& faces,
                                     const Positions& positions, std::uint32_t start,
                                     const Eigen::Vector3d& point);

/// Returns a point of the surface near the query point. Walks from `start` from triangle to
/// triangle as long as the distance decreases. Allocates no memory. Suits query points near a known
/// vertex.
SurfacePoint nearest_point_from(const Topology& topology, const VertexFaces& faces,
                                const Positions& positions, std::uint32_t start,
                                const Eigen::Vector3d& point);

/// Returns the unit normal of the triangle that contains a surface point; zero if the triangle has
/// no area.
Eigen::Vector3d normal_at(const Positions& positions, const SurfacePoint& place);

}  // namespace crowdface
