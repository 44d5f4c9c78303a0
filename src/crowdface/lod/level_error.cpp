// SPDX-License-Identifier: Apache-2.0
#include "crowdface/lod/level_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/edge_distances.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {
namespace {

constexpr std::ptrdiff_t kVerticesPerBlock = 1024;

double distance_to(const Positions& rows, const Triangle& triangle, const Eigen::Vector3d& point) {
  const double to_corner = (point - row3(rows, triangle[0])).norm();
  if (triangle[0] == triangle[1]) return to_corner;
  const auto barycentric = nearest_in_triangle(row3(rows, triangle[0]), row3(rows, triangle[1]),
                                               row3(rows, triangle[2]), point);
  const double distance = (point - point_on(rows, triangle, barycentric)).norm();
  return std::isnan(distance) ? to_corner : distance;
}

/// Walks along the surface of a level from a vertex towards `point`. Each step searches the
/// polygons around the vertex nearest to `point` so far. Returns the smallest distance between
/// `point` and the polygons that were searched.
double distance_by_walk(const DetailLevel& level, const VertexFaces& around, const Positions& rows,
                        std::uint32_t start, const Eigen::Vector3d& point) {
  constexpr int kMaxSteps = 16;
  SurfacePoint best = nearest_point_around(level.topology, around, rows, start, point);
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto most = std::ranges::max_element(best.barycentric);
    const std::uint32_t vertex =
        best.corners[static_cast<std::size_t>(most - best.barycentric.begin())];
    const SurfacePoint next = nearest_point_around(level.topology, around, rows, vertex, point);
    if (!(next.distance < best.distance)) break;
    best = next;
  }
  return best.distance;
}

}  // namespace

NearestLevelTriangles find_level_triangles(const Topology& whole, const Adjacency& adjacency,
                                           const DetailLevel& level,
                                           const Positions& typical_positions) {
  std::vector<bool> dropped(static_cast<std::size_t>(whole.vertex_count), false);
  for (const std::uint32_t vertex : whole.corner_vertices) dropped[vertex] = true;
  for (const std::uint32_t vertex : level.vertices) dropped[vertex] = false;
  NearestLevelTriangles map;
  for (std::uint32_t v = 0; v < dropped.size(); ++v) {
    if (dropped[v]) map.vertices.push_back(v);
  }
  if (level.vertices.empty()) return map;
  const Positions rows = level.restrict_rows(typical_positions);
  std::vector<std::uint32_t> all(level.vertices.size());
  std::iota(all.begin(), all.end(), 0U);
  const PointGrid grid(rows, all);
  const VertexFaces around(level.topology);
  const std::vector<std::uint32_t> starts =
      nearest_along_edges(adjacency, typical_positions, level.vertices);
  map.triangles.resize(map.vertices.size());
  parallel_for_each(map.vertices.size(), kVerticesPerBlock, [&](std::size_t i) {
    const Eigen::Vector3d point = row3(typical_positions, map.vertices[i]);
    const std::uint32_t start = starts[map.vertices[i]];
    const SurfacePoint place =
        nearest_point_from(level.topology, around, rows,
                           start == kNoIndex ? grid.nearest(point).vertex : start, point);
    map.triangles[i] = place.corners;
  });
  return map;
}

LevelError level_error(const DetailLevel& level, const NearestLevelTriangles& map,
                       std::span<const Positions* const> meshes) {
  const VertexFaces around(level.topology);
  std::vector<double> distances(map.triangles.size());
  const auto mean_square = [&] {
    double sum = 0;
    for (const double distance : distances) sum += distance * distance;
    return sum / static_cast<double>(std::max<std::size_t>(1, distances.size()));
  };
  LevelError error;
  double squares = 0;
  for (const Positions* mesh : meshes) {
    const Positions rows = level.restrict_rows(*mesh);
    const auto point = [&](std::size_t i) { return row3(*mesh, map.vertices[i]); };
    parallel_for_each(distances.size(), kVerticesPerBlock, [&](std::size_t i) {
      distances[i] = distance_to(rows, map.triangles[i], point(i));
    });
    // If a vertex is far from its mapped triangle, look for a nearer triangle.
    const double far = 4 * std::sqrt(mean_square());
    parallel_for_each(distances.size(), kVerticesPerBlock, [&](std::size_t i) {
      if (distances[i] <= far) return;
      distances[i] = std::min(distances[i],
                              distance_by_walk(level, around, rows, map.triangles[i][0], point(i)));
    });
    squares += mean_square() / static_cast<double>(meshes.size());
    for (const double distance : distances) error.max = std::max(error.max, distance);
  }
  error.root_mean_square = std::sqrt(squares);
  return error;
}

}  // namespace crowdface
