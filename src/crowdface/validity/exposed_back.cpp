// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/exposed_back.h"

#include <algorithm>
#include <array>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

/// What is seen at a flatter angle is hardly seen.
constexpr double kFlattestCosine = 0.2;
/// How far apart the points of a triangle are that are looked for, and how many there are along an edge.
constexpr double kSpacingMm = 1;
constexpr int kMostAlongEdge = 8;

using Corners = std::array<Eigen::Vector3d, 3>;

Corners corners(const Positions& positions, const Triangle& triangle) {
  return {row3(positions, triangle[0]), row3(positions, triangle[1]), row3(positions, triangle[2])};
}

int points_along_edge(const Corners& at, double mm_per_unit) {
  const double longest =
      std::max({length3(at[1] - at[0]), length3(at[2] - at[1]), length3(at[0] - at[2])});
  return std::clamp(static_cast<int>(longest * mm_per_unit / kSpacingMm), 1, kMostAlongEdge);
}

/// Which share of a triangle shows its back, told at the middles of n² equal triangles that it is cut into.
/// \param in_the_way  #directions: of the last ray to each viewer
double exposed_share(const TriangleScene& scene, const Corners& at, std::uint32_t triangle,
                     const Viewing& viewing, std::span<std::uint32_t> in_the_way) {
  const Eigen::Vector3d normal = cross3(at[1] - at[0], at[2] - at[0]);
  std::vector<std::size_t> behind;
  for (std::size_t i = 0; i < viewing.directions.size(); ++i) {
    const Eigen::Vector3d& viewer = viewing.directions[i];
    if (-dot3(normal, viewer) > kFlattestCosine * length3(normal) * length3(viewer)) {
      behind.push_back(i);
    }
  }
  if (behind.empty()) return 0;
  const int n = points_along_edge(at, viewing.mm_per_unit);
  int shown = 0;
  const auto look_at = [&](int thirds_b, int thirds_c) {
    const double b = thirds_b / (3.0 * n), c = thirds_c / (3.0 * n);
    const Eigen::Vector3d point = (1 - b - c) * at[0] + b * at[1] + c * at[2];
    shown += std::ranges::any_of(behind, [&](std::size_t viewer) {
      std::uint32_t& other = in_the_way[viewer];
      other = scene.met_by(point, viewing.directions[viewer], triangle, other);
      return other == kNoIndex;
    });
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      look_at(3 * i + 1, 3 * j + 1);
      if (i + j < n - 1) look_at(3 * i + 2, 3 * j + 2);
    }
  }
  return static_cast<double>(shown) / (n * n);
}

}  // namespace

TriangleNeighbours::TriangleNeighbours(const std::vector<Triangle>& triangles, Index vertex_count)
    : offsets_(static_cast<std::size_t>(vertex_count) + 1, 0), triangles_(3 * triangles.size()) {
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t vertex : triangle) ++offsets_[vertex + 1];
  }
  for (std::size_t v = 1; v < offsets_.size(); ++v) offsets_[v] += offsets_[v - 1];
  std::vector<std::uint32_t> next = offsets_;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t vertex : triangles[t]) triangles_[next[vertex]++] = t;
  }
}

std::span<const std::uint32_t> TriangleNeighbours::around(std::uint32_t vertex) const {
  return std::span(triangles_).subspan(offsets_[vertex], offsets_[vertex + 1] - offsets_[vertex]);
}

double exposed_back(const TriangleScene& scene, const std::vector<Triangle>& triangles,
                    const Positions& positions, const TriangleNeighbours& neighbours,
                    const std::vector<TrianglePair>& intersecting, const Viewing& viewing) {
  std::vector<bool> seen(triangles.size(), false);
  std::vector<std::uint32_t> waiting;
  const auto look_around = [&](std::uint32_t triangle) {
    for (const std::uint32_t vertex : triangles[triangle]) {
      for (const std::uint32_t other : neighbours.around(vertex)) {
        if (seen[other]) continue;
        seen[other] = true;
        waiting.push_back(other);
      }
    }
  };
  for (const auto& [a, b] : intersecting) {
    look_around(a);
    look_around(b);
  }
  std::vector<std::uint32_t> in_the_way(viewing.directions.size(), kNoIndex);
  double exposed = 0;
  while (!waiting.empty()) {
    const std::uint32_t t = waiting.back();
    waiting.pop_back();
    const double share =
        exposed_share(scene, corners(positions, triangles[t]), t, viewing, in_the_way);
    if (share == 0) continue;
    exposed += 0.5 * share * length3(area_vector(positions, triangles[t]));
    look_around(t);
  }
  return exposed;
}

}  // namespace crowdface
