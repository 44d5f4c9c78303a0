// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "crowdface/mesh/triangles.h"
#include "crowdface/parts/point_grid.h"

namespace crowdface {

/// A place on a triangle of a mesh; larger polygons are cut into fans from their first corner.
struct SurfacePoint {
  Triangle corners = {};
  std::array<double, 3> shares = {};  ///< barycentric, not negative, of sum one
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double distance = 0;  ///< from the point that was asked about
};

/// Of a triangle the point with these barycentric coordinates.
Eigen::Vector3d point_on(const Positions& positions, const Triangle& corners,
                         const std::array<double, 3>& shares);

/// The place nearest to a point among the triangles around one vertex and its neighbours.
SurfacePoint nearest_around(const Topology& topology, const FacesAround& faces,
                            const Positions& positions, std::uint32_t vertex,
                            const Eigen::Vector3d& point);

/// From `start` on along the mesh for as long as a vertex of a face around comes nearer to the point: a
/// cheaper way to where nearest_from may start.
std::uint32_t descend(const Topology& topology, const FacesAround& faces,
                      const Positions& positions, std::uint32_t start,
                      const Eigen::Vector3d& point);

/// The same for points near a vertex already known, without memory of its own: from `start` on, from
/// triangle to triangle for as long as that comes nearer.
SurfacePoint nearest_from(const Topology& topology, const FacesAround& faces,
                          const Positions& positions, std::uint32_t start,
                          const Eigen::Vector3d& point);

/// Unit normal of the triangle of a place; zero if it has no area.
Eigen::Vector3d normal_at(const Positions& positions, const SurfacePoint& place);

}  // namespace crowdface
