// SPDX-License-Identifier: Apache-2.0
#include "support/self_crossing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <Eigen/Geometry>

namespace crowdface::testing {
namespace {

using Eigen::Vector3d;

struct Triangle {
  std::array<Vector3d, 3> at;
  std::array<std::uint32_t, 3> vertices;
  Index face;
};

std::vector<Triangle> triangles_of(const Topology& topology, const Positions& positions) {
  std::vector<Triangle> out;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    for (std::size_t k = 2; k < face.size(); ++k) {
      const std::array<std::uint32_t, 3> v = {face[0], face[k - 1], face[k]};
      out.push_back({{positions.row(v[0]), positions.row(v[1]), positions.row(v[2])}, v, f});
    }
  }
  return out;
}

/// Does the edge from p to q pass through the triangle's inside?
bool pierces(const Vector3d& p, const Vector3d& q, const Triangle& triangle) {
  const auto& [a, b, c] = triangle.at;
  const Vector3d normal = (b - a).cross(c - a);
  const double before = normal.dot(p - a), after = normal.dot(q - a);
  if ((before > 0) == (after > 0)) return false;
  const Vector3d x = p + before / (before - after) * (q - p);
  return normal.dot((b - a).cross(x - a)) > 0 && normal.dot((c - b).cross(x - b)) > 0 &&
         normal.dot((a - c).cross(x - c)) > 0;
}

bool cross(const Triangle& a, const Triangle& b) {
  for (const std::uint32_t v : a.vertices) {
    if (std::ranges::find(b.vertices, v) != b.vertices.end()) return false;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (pierces(a.at[k], a.at[(k + 1) % 3], b) || pierces(b.at[k], b.at[(k + 1) % 3], a)) {
      return true;
    }
  }
  return false;
}

/// A triangle in each cell of the grid that its box touches.
struct Entry {
  std::array<long, 3> cell;
  std::size_t triangle;
};

std::vector<Entry> sorted_into_cells(const std::vector<Triangle>& triangles, double cell) {
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i].at;
    const Vector3d low = a.cwiseMin(b).cwiseMin(c) / cell, high = a.cwiseMax(b).cwiseMax(c) / cell;
    const auto floor = [](double x) { return static_cast<long>(std::floor(x)); };
    for (long x = floor(low.x()); x <= floor(high.x()); ++x) {
      for (long y = floor(low.y()); y <= floor(high.y()); ++y) {
        for (long z = floor(low.z()); z <= floor(high.z()); ++z) entries.push_back({{x, y, z}, i});
      }
    }
  }
  std::ranges::sort(entries, [](const Entry& a, const Entry& b) {
    return std::tie(a.cell, a.triangle) < std::tie(b.cell, b.triangle);
  });
  return entries;
}

}  // namespace

std::vector<std::pair<Index, Index>> find_self_crossings(const Topology& topology,
                                                         const Positions& positions, double cell) {
  const std::vector<Triangle> triangles = triangles_of(topology, positions);
  const std::vector<Entry> entries = sorted_into_cells(triangles, cell);
  std::vector<std::pair<Index, Index>> found;
  for (std::size_t first = 0, last = 0; first < entries.size(); first = last) {
    while (last < entries.size() && entries[last].cell == entries[first].cell) ++last;
    for (std::size_t i = first; i < last; ++i) {
      for (std::size_t j = first; j < i; ++j) {
        const Triangle& a = triangles[entries[j].triangle];
        const Triangle& b = triangles[entries[i].triangle];
        if (cross(a, b)) found.emplace_back(a.face, b.face);
      }
    }
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace crowdface::testing
