// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/point_carrier.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {
namespace {

double nearest(const Eigen::Vector3d& point, const Positions& mesh,
               std::span<const std::uint32_t> vertices) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t v : vertices) least = std::min(least, (row3(mesh, v) - point).norm());
  return least;
}

/// Returns whether a point is nearer to an eyeball's centre than all vertices of the eyeball.
bool is_in_eyeball(const Eigen::Vector3d& point, const Positions& mesh, const Part& eyeball) {
  const Eigen::Vector3d middle = centre_of(mesh, eyeball.ball_vertices);
  return (point - middle).norm() < nearest(middle, mesh, eyeball.ball_vertices);
}

}  // namespace

PointCarrier::PointCarrier(const PointSet& points, const PartList& parts,
                           std::span<const std::uint32_t> skin, std::span<const Triangle> triangles)
    : points_(points), anchors_(points.meshes.size()) {
  for (std::size_t m = 0; m < anchors_.size(); ++m) {
    for (std::size_t p = 0; p < points.names.size(); ++p) {
      const Eigen::Vector3d point = row3(points.positions[m], static_cast<Index>(p));
      const auto on_surface = point_on_surface(point, points.meshes[m], triangles);
      anchors_[m].push_back(
          on_surface ? Anchor(*on_surface)
                     : Anchor(find_carrying_vertices(point, points.meshes[m], parts, skin)));
    }
  }
}

std::optional<PointCarrier::TrianglePoint> PointCarrier::point_on_surface(
    const Eigen::Vector3d& point, const Positions& mesh, std::span<const Triangle> triangles) {
  // Largest distance of a point that counts as on the surface, as a fraction of the mesh's size.
  // The distance may exceed zero because files contain rounded coordinates.
  constexpr double kSurfaceTolerance = 1e-5;
  double least =
      kSurfaceTolerance * (mesh.colwise().maxCoeff() - mesh.colwise().minCoeff()).maxCoeff();
  std::optional<TrianglePoint> found;
  for (const Triangle& corners : triangles) {
    const auto [low, high] =
        std::minmax({mesh(corners[0], 0), mesh(corners[1], 0), mesh(corners[2], 0)});
    if (low > point.x() + least || high < point.x() - least) continue;
    const auto barycentric = nearest_in_triangle(row3(mesh, corners[0]), row3(mesh, corners[1]),
                                                 row3(mesh, corners[2]), point);
    const double distance = (point_on(mesh, corners, barycentric) - point).norm();
    if (!(distance < least)) continue;  // also a triangle without area
    least = distance;
    found = TrianglePoint{corners, barycentric};
  }
  return found;
}

Socket PointCarrier::find_carrying_vertices(const Eigen::Vector3d& point, const Positions& mesh,
                                            const PartList& parts,
                                            std::span<const std::uint32_t> skin) {
  const auto whole = [](const std::vector<std::uint32_t>& vertices) {
    return Socket{vertices, std::vector<double>(vertices.size(), 1.0)};
  };
  const double to_skin = nearest(point, mesh, skin);
  for (const Part& part : parts.parts) {
    if (part.is_eyeball && is_in_eyeball(point, mesh, part)) return whole(part.ball_vertices);
  }
  for (const Part& part : parts.parts) {
    if (part.part_class == PartClass::kRigid && nearest(point, mesh, part.vertices) < to_skin) {
      return whole(part.vertices);
    }
  }
  // A point follows the skin vertices that are at most kMaxDistanceRatio times as far away as the
  // nearest skin vertex. If there are fewer than kMin of these vertices, the point follows the kMin
  // nearest skin vertices. So a point deep inside the head follows the skin on all sides.
  constexpr double kMaxDistanceRatio = 1.5;
  constexpr std::size_t kMin = 60;
  std::vector<std::pair<double, std::uint32_t>> by_distance;
  for (const std::uint32_t v : skin) by_distance.emplace_back((row3(mesh, v) - point).norm(), v);
  std::sort(by_distance.begin(), by_distance.end());
  const std::size_t fewest = std::min(kMin, by_distance.size());
  const double reach = std::max(kMaxDistanceRatio * to_skin, by_distance[fewest - 1].first);
  const double fades = 1.05 * reach;
  Socket anchor;
  for (const auto& [distance, vertex] : by_distance) {
    if (distance > reach) break;
    const double left = 1 - distance * distance / (fades * fades);
    anchor.vertices.push_back(vertex);
    anchor.weights.push_back(left * left);
  }
  return anchor;
}

Positions PointCarrier::place_points(Index target, const Positions& face) const {
  const std::size_t m = points_.meshes.size() > 1 ? static_cast<std::size_t>(target) : 0;
  Positions carried(static_cast<Index>(points_.names.size()), 3);
  for (Index p = 0; p < carried.rows(); ++p) {
    const Anchor& anchor = anchors_[m][static_cast<std::size_t>(p)];
    if (const auto* on_surface = std::get_if<TrianglePoint>(&anchor)) {
      carried.row(p) = point_on(face, on_surface->corners, on_surface->barycentric).transpose();
      continue;
    }
    const auto& socket = std::get<Socket>(anchor);
    const RigidMotion motion =
        fit_rigid_motion(points_.meshes[m], face, socket.vertices, socket.weights);
    carried.row(p) = motion.apply(row3(points_.positions[m], p)).transpose();
  }
  return carried;
}

}  // namespace crowdface
