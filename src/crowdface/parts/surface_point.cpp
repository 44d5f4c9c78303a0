// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/surface_point.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crowdface/core/contains.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

SurfacePoint bare_vertex(const Positions& positions, std::uint32_t vertex,
                         const Eigen::Vector3d& point) {
  const Eigen::Vector3d place = row3(positions, vertex);
  return {{vertex, vertex, vertex}, {1, 0, 0}, place, (point - place).norm()};
}

/// Sets `best` to the point of the polygon that is nearest to `point`, if this point is nearer than
/// `best`, or if `best` is still a vertex instead of a point in a triangle. For a vertex, all three
/// entries of best.corners are equal.
void try_face(std::span<const std::uint32_t> face, const Positions& positions,
              const Eigen::Vector3d& point, SurfacePoint& best) {
  for (std::size_t k = 1; k + 1 < face.size(); ++k) {
    const Triangle corners = {face[0], face[k], face[k + 1]};
    const std::array<double, 3> barycentric =
        nearest_in_triangle(row3(positions, corners[0]), row3(positions, corners[1]),
                            row3(positions, corners[2]), point);
    const Eigen::Vector3d place = point_on(positions, corners, barycentric);
    const double distance = (point - place).norm();
    if (std::isnan(distance)) continue;  // a triangle without area
    if (distance < best.distance || best.corners[0] == best.corners[1]) {
      best = {corners, barycentric, place, distance};
    }
  }
}

}  // namespace

Eigen::Vector3d point_on(const Positions& positions, const Triangle& corners,
                         const std::array<double, 3>& barycentric) {
  return barycentric[0] * row3(positions, corners[0]) +
         barycentric[1] * row3(positions, corners[1]) +
         barycentric[2] * row3(positions, corners[2]);
}

SurfacePoint nearest_point_around(const Topology& topology, const VertexFaces& faces,
                                  const Positions& positions, std::uint32_t vertex,
                                  const Eigen::Vector3d& point) {
  std::vector<std::uint32_t> near;
  for (const std::uint32_t f : faces.items_of(vertex)) {
    for (const std::uint32_t v : topology.face(f)) {
      near.insert(near.end(), faces.items_of(v).begin(), faces.items_of(v).end());
    }
  }
  std::ranges::sort(near);
  near.erase(std::unique(near.begin(), near.end()), near.end());
  SurfacePoint best = bare_vertex(positions, vertex, point);
  for (const std::uint32_t f : near) try_face(topology.face(f), positions, point, best);
  return best;
}

std::uint32_t walk_to_nearest_vertex(const Topology& topology, const VertexFaces& faces,
                                     const Positions& positions, std::uint32_t start,
                                     const Eigen::Vector3d& point) {
  const auto square_to = [&](std::uint32_t vertex) {
    const Eigen::Vector3d from = row3(positions, vertex) - point;
    return from.squaredNorm();
  };
  double least = square_to(start);
  for (std::uint32_t vertex = start;;) {
    for (const std::uint32_t f : faces.items_of(vertex)) {
      for (const std::uint32_t v : topology.face(f)) {
        const double square = square_to(v);
        if (square >= least) continue;
        least = square;
        start = v;
      }
    }
    if (start == vertex) return vertex;
    vertex = start;
  }
}

SurfacePoint nearest_point_from(const Topology& topology, const VertexFaces& faces,
                                const Positions& positions, std::uint32_t start,
                                const Eigen::Vector3d& point) {
  constexpr int kMaxSteps = 64;
  SurfacePoint best = bare_vertex(positions, start, point);
  std::uint32_t vertex = start, before = kNoIndex;
  for (int step = 0; step < kMaxSteps; ++step) {
    for (const std::uint32_t f : faces.items_of(vertex)) {
      const auto face = topology.face(f);
      if (!contains(face, before)) try_face(face, positions, point, best);
    }
    std::size_t most = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (best.barycentric[k] > best.barycentric[most]) most = k;
    }
    if (best.corners[most] == vertex) break;
    before = std::exchange(vertex, best.corners[most]);
  }
  return best;
}

Eigen::Vector3d normal_at(const Positions& positions, const SurfacePoint& place) {
  return area_vector(positions, place.corners).normalized();
}

}  // namespace crowdface
