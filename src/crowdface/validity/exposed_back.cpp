// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/exposed_back.h"

#include <algorithm>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

/// What is seen at a flatter angle is hardly seen.
constexpr double kFlattestCosine = 0.2;

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
                    const std::vector<TrianglePair>& intersecting,
                    const std::vector<Eigen::Vector3d>& viewers) {
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
  double exposed = 0;
  while (!waiting.empty()) {
    const std::uint32_t t = waiting.back();
    waiting.pop_back();
    const Eigen::Vector3d doubled = area_vector(positions, triangles[t]);
    const double length = length3(doubled);
    const Eigen::Vector3d middle =
        (row3(positions, triangles[t][0]) + row3(positions, triangles[t][1]) +
         row3(positions, triangles[t][2])) /
        3.0;
    const bool shows = std::any_of(viewers.begin(), viewers.end(), [&](const auto& viewer) {
      return -dot3(doubled, viewer) > kFlattestCosine * length * length3(viewer) &&
             !scene.meets(middle, viewer, t);
    });
    if (!shows) continue;
    exposed += 0.5 * length;
    look_around(t);
  }
  return exposed;
}

}  // namespace crowdface
