// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <queue>

#include "crowdface/core/contains.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// The update step of fast marching in a triangle abc: returns the distance of c from a source.
/// `from_a` and `from_b` are the distances of a and b from this source. Unfolds the triangle into a
/// plane that contains the source. If the straight path from the source to c does not cross the
/// edge ab, the result is the length of the shorter path to c through a or b.
double unfolded_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                         const Eigen::Vector3d& c, double from_a, double from_b) {
  const double along_edges = std::min(from_a + (c - a).norm(), from_b + (c - b).norm());
  const double length = (b - a).norm();
  if (!(length > 0)) return along_edges;
  // Coordinates in the plane: a = (0, 0), b = (length, 0), c = (c_x, c_y), source = (x, −y).
  const double x = (from_a * from_a - from_b * from_b + length * length) / (2 * length);
  const double y = std::sqrt(std::max(0.0, from_a * from_a - x * x));
  const double c_x = (c - a).dot(b - a) / length;
  const double c_y = std::sqrt(std::max(0.0, (c - a).squaredNorm() - c_x * c_x));
  if (!(y + c_y > 0)) return along_edges;
  const double crossing = x + (c_x - x) * y / (y + c_y);
  if (crossing < 0 || crossing > length) return along_edges;
  return std::sqrt((c_x - x) * (c_x - x) + (c_y + y) * (c_y + y));
}

/// Computes SurfaceDistance::next_twins_.
std::vector<std::uint32_t> find_twins(const Adjacency& adjacency, const Positions& positions) {
  std::vector<std::uint32_t> twins(static_cast<std::size_t>(positions.rows()));
  std::iota(twins.begin(), twins.end(), 0U);
  const Components components = find_components(adjacency);
  std::map<std::array<double, 3>, std::vector<std::uint32_t>> vertices_at;
  for (std::uint32_t v = 0; v < twins.size(); ++v) {
    if (!adjacency.boundary[v]) continue;
    auto& there = vertices_at[{positions(v, 0), positions(v, 1), positions(v, 2)}];
    const auto is_of_same = [&](std::uint32_t other) {
      return components.component_of_vertex[other] == components.component_of_vertex[v];
    };
    if (std::ranges::none_of(there, is_of_same)) there.push_back(v);
  }
  for (const auto& [place, there] : vertices_at) {
    for (std::size_t i = 0; i < there.size(); ++i) {
      twins[there[i]] = there[(i + 1) % there.size()];
    }
  }
  return twins;
}

std::vector<std::uint32_t> used_vertices(const Adjacency& adjacency) {
  std::vector<std::uint32_t> used;
  for (std::uint32_t v = 0; v < adjacency.group_count(); ++v) {
    if (!adjacency.items_of(v).empty()) used.push_back(v);
  }
  if (used.empty()) used.push_back(0);
  return used;
}

}  // namespace

SurfaceDistance::SurfaceDistance(const Topology& topology, const Positions& positions)
    : topology_(topology),
      positions_(positions),
      adjacency_(build_adjacency(topology)),
      faces_(topology),
      next_twins_(find_twins(adjacency_, positions)),
      grid_(positions, used_vertices(adjacency_)) {}

SurfacePoint SurfaceDistance::nearest(const Eigen::Vector3d& point) const {
  return nearest_point_around(topology_, faces_, positions_, grid_.nearest(point).vertex, point);
}

std::vector<std::uint32_t> SurfaceDistance::adjacent_vertices(std::uint32_t vertex) const {
  std::vector<std::uint32_t> out;
  std::uint32_t at = vertex;
  do {
    const auto neighbours = adjacency_.items_of(at);
    out.insert(out.end(), neighbours.begin(), neighbours.end());
    at = next_twins_[at];
  } while (at != vertex);
  return out;
}

std::vector<SurfaceDistance::ReachedVertex> SurfaceDistance::vertices_within(
    const std::vector<SurfacePoint>& points, double reach) const {
  std::vector<double> distance(next_twins_.size(), kFar);
  std::vector<bool> done(next_twins_.size(), false);
  using Front = std::pair<double, std::uint32_t>;
  std::priority_queue<Front, std::vector<Front>, std::greater<>> front;
  const auto reached = [&](std::uint32_t vertex, double way) {
    if (!(way < distance[vertex]) || way > reach) return;
    distance[vertex] = way;
    front.emplace(way, vertex);
  };
  for (const SurfacePoint& place : points) {
    // Start from all corners of the polygon that contains the triangle of the start point, so that
    // both triangles of a quad are treated alike.
    for (const std::uint32_t f : faces_.items_of(place.corners[0])) {
      const auto face = topology_.face(f);
      if (!contains(face, place.corners[1]) || !contains(face, place.corners[2])) continue;
      for (const std::uint32_t v : face) {
        reached(v, (row3(positions_, v) - place.position).norm());
      }
    }
  }
  std::vector<ReachedVertex> out;
  while (!front.empty()) {
    const auto [way, vertex] = front.top();
    front.pop();
    if (done[vertex]) continue;
    done[vertex] = true;
    out.push_back({vertex, way});
    if (next_twins_[vertex] != vertex) reached(next_twins_[vertex], way);
    const Eigen::Vector3d here = row3(positions_, vertex);
    for (const std::uint32_t f : faces_.items_of(vertex)) {
      const auto face = topology_.face(f);
      for (std::size_t i = 0; i < face.size(); ++i) {
        const std::uint32_t to = face[i];
        if (to == vertex || done[to]) continue;
        const Eigen::Vector3d there = row3(positions_, to);
        reached(to, way + (there - here).norm());
        for (std::size_t j = 0; j < face.size(); ++j) {
          const std::uint32_t other = face[j];
          const bool near = face.size() <= 4 || (i + 1) % face.size() == j ||
                            // In polygons with more than four corners, only neighbouring corners
                            // are connected.
                            (j + 1) % face.size() == i;
          if (!near || other == vertex || other == to || distance[other] == kFar) continue;
          reached(to,
                  unfolded_distance(here, row3(positions_, other), there, way, distance[other]));
        }
      }
    }
  }
  std::ranges::sort(out, {}, &ReachedVertex::vertex);
  return out;
}

}  // namespace crowdface
