// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/surface_point.h"

#include <algorithm>
#include <cmath>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

/// Barycentric coordinates of the point of a triangle nearest to p (Ericson 2005, "Real-Time
/// Collision Detection", §5.1.5).
std::array<double, 3> nearest_in_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                          const Eigen::Vector3d& c, const Eigen::Vector3d& p) {
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot3(ab, ap), d2 = dot3(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = dot3(ab, bp), d4 = dot3(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double d5 = dot3(ab, cp), d6 = dot3(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double v = d1 / (d1 - d3);
    return {1 - v, v, 0};
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double w = d2 / (d2 - d6);
    return {1 - w, 0, w};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

Eigen::Vector3d row3(const Positions& positions, std::uint32_t vertex) {
  return positions.row(vertex).transpose();
}

}  // namespace

FacesAround::FacesAround(const Topology& topology)
    : offsets_(static_cast<std::size_t>(topology.vertex_count) + 1, 0) {
  for (const std::uint32_t vertex : topology.corner_vertices) ++offsets_[vertex + 1];
  for (std::size_t v = 1; v < offsets_.size(); ++v) offsets_[v] += offsets_[v - 1];
  std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end() - 1);
  faces_.resize(topology.corner_vertices.size());
  for (Index f = 0; f < topology.face_count(); ++f) {
    for (const std::uint32_t vertex : topology.face(f)) {
      faces_[next[vertex]++] = static_cast<std::uint32_t>(f);
    }
  }
}

SurfacePoint nearest_around(const Topology& topology, const FacesAround& faces,
                            const Positions& positions, std::uint32_t vertex,
                            const Eigen::Vector3d& point) {
  std::vector<std::uint32_t> near;
  for (const std::uint32_t f : faces.of(vertex)) {
    for (const std::uint32_t v : topology.face(f)) {
      near.insert(near.end(), faces.of(v).begin(), faces.of(v).end());
    }
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  SurfacePoint best;
  best.corners = {vertex, vertex, vertex};
  best.shares = {1, 0, 0};
  best.position = positions.row(vertex).transpose();
  best.distance = length3(point - best.position);
  for (const std::uint32_t f : near) {
    const auto face = topology.face(f);
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      const Eigen::Vector3d a = positions.row(face[0]).transpose();
      const Eigen::Vector3d b = positions.row(face[k]).transpose();
      const Eigen::Vector3d c = positions.row(face[k + 1]).transpose();
      const std::array<double, 3> shares = nearest_in_triangle(a, b, c, point);
      const Eigen::Vector3d place = shares[0] * a + shares[1] * b + shares[2] * c;
      const double distance = length3(point - place);
      // Of equals the first, but a triangle rather than the bare vertex.
      if (distance < best.distance ||
          (distance == best.distance && best.corners[0] == best.corners[1])) {
        best = {{face[0], face[k], face[k + 1]}, shares, place, distance};
      }
    }
  }
  return best;
}

std::uint32_t descend(const Topology& topology, const FacesAround& faces,
                      const Positions& positions, std::uint32_t start,
                      const Eigen::Vector3d& point) {
  const auto square_to = [&](std::uint32_t vertex) {
    const Eigen::Vector3d from = row3(positions, vertex) - point;
    return dot3(from, from);
  };
  double least = square_to(start);
  for (std::uint32_t vertex = start;;) {
    for (const std::uint32_t f : faces.of(vertex)) {
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

SurfacePoint nearest_from(const Topology& topology, const FacesAround& faces,
                          const Positions& positions, std::uint32_t start,
                          const Eigen::Vector3d& point) {
  constexpr int kMostSteps = 64;
  SurfacePoint best;
  best.corners = {start, start, start};
  best.shares = {1, 0, 0};
  best.position = row3(positions, start);
  best.distance = length3(point - best.position);
  std::uint32_t vertex = start;
  for (int step = 0; step < kMostSteps; ++step) {
    for (const std::uint32_t f : faces.of(vertex)) {
      const auto face = topology.face(f);
      const Eigen::Vector3d a = row3(positions, face[0]);
      for (std::size_t k = 1; k + 1 < face.size(); ++k) {
        const Eigen::Vector3d b = row3(positions, face[k]), c = row3(positions, face[k + 1]);
        const std::array<double, 3> shares = nearest_in_triangle(a, b, c, point);
        const Eigen::Vector3d place = shares[0] * a + shares[1] * b + shares[2] * c;
        const double distance = length3(point - place);
        if (distance < best.distance || best.corners[0] == best.corners[1]) {
          best = {{face[0], face[k], face[k + 1]}, shares, place, distance};
        }
      }
    }
    std::size_t most = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (best.shares[k] > best.shares[most]) most = k;
    }
    if (best.corners[most] == vertex) break;
    vertex = best.corners[most];
  }
  return best;
}

Eigen::Vector3d normal_at(const Positions& positions, const SurfacePoint& place) {
  const Eigen::Vector3d a = positions.row(place.corners[0]).transpose();
  const Eigen::Vector3d b = positions.row(place.corners[1]).transpose();
  const Eigen::Vector3d c = positions.row(place.corners[2]).transpose();
  return unit3(cross3(b - a, c - a));
}

}  // namespace crowdface
