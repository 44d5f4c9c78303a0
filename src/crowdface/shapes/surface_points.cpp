// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/surface_points.h"

#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {

SurfacePoints::SurfacePoints(const PointSet& points, std::span<const Triangle> triangles)
    : surface_points_(points.meshes.size()) {
  for (std::size_t m = 0; m < surface_points_.size(); ++m) {
    for (Index p = 0; p < points.positions[m].rows(); ++p) {
      surface_points_[m].push_back(
          point_on_surface(row3(points.positions[m], p), points.meshes[m], triangles));
    }
  }
}

std::optional<SurfacePoints::TrianglePoint> SurfacePoints::point_on_surface(
    const Eigen::Vector3d& point, const Positions& mesh, std::span<const Triangle> triangles) {
  // Largest distance of a point that counts as on the surface, as a fraction of the mesh's size:
  // files contain rounded numbers.
  constexpr double kNearAsShareOfSize = 1e-5;
  double least =
      kNearAsShareOfSize * (mesh.colwise().maxCoeff() - mesh.colwise().minCoeff()).maxCoeff();
  std::optional<TrianglePoint> place;
  for (const Triangle& corners : triangles) {
    const auto shares = nearest_in_triangle(row3(mesh, corners[0]), row3(mesh, corners[1]),
                                            row3(mesh, corners[2]), point);
    const double distance = (point_on(mesh, corners, shares) - point).norm();
    if (!(distance < least)) continue;  // also a triangle without area
    least = distance;
    place = TrianglePoint{corners, shares};
  }
  return place;
}

void SurfacePoints::place(Index target, const Positions& face, Positions& carried) const {
  const auto& places =
      surface_points_[surface_points_.size() > 1 ? static_cast<std::size_t>(target) : 0];
  for (Index p = 0; p < carried.rows(); ++p) {
    const auto& place = places[static_cast<std::size_t>(p)];
    if (place) carried.row(p) = point_on(face, place->corners, place->shares).transpose();
  }
}

}  // namespace crowdface
