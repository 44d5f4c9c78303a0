// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/proxy_skin.h"

#include <algorithm>

namespace crowdface {
namespace {

/// Parts of the skin that are this near on the mean head may intersect on a face.
constexpr double kReach = 3;  // mm, for each of the two parts
/// Triangles at most this many edges apart are neighbours. Folds between neighbours are detected as
/// flips.
constexpr int kNeighbourEdges = 3;

using Rings = std::vector<std::vector<std::uint32_t>>;

Rings rings_of(const std::vector<Triangle>& triangles, Index vertices) {
  Rings rings(static_cast<std::size_t>(vertices));
  for (const Triangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      rings[t[c]].push_back(t[(c + 1) % 3]);
      rings[t[c]].push_back(t[(c + 2) % 3]);
    }
  }
  for (auto& ring : rings) {
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  }
  return rings;
}

/// Marks the vertices at most kNeighbourEdges edges away from a triangle.
void mark_neighbourhood(const Rings& rings, const Triangle& t, std::uint32_t mark,
                        std::vector<std::uint32_t>& marks) {
  std::vector<std::uint32_t> reached(t.begin(), t.end());
  for (const std::uint32_t vertex : t) marks[vertex] = mark;
  std::size_t begin = 0;
  for (int e = 0; e < kNeighbourEdges; ++e) {
    const std::size_t end = reached.size();
    for (; begin < end; ++begin) {
      for (const std::uint32_t next : rings[reached[begin]]) {
        if (marks[next] == mark) continue;
        marks[next] = mark;
        reached.push_back(next);
      }
    }
  }
}

/// Returns pairs of triangles that are near each other without being neighbours.
std::vector<TrianglePair> facing_pairs(const std::vector<Triangle>& triangles,
                                       const Positions& mean) {
  const Rings rings = rings_of(triangles, mean.rows());
  std::vector<TrianglePair> pairs;
  std::vector<std::uint32_t> neighbour_of(rings.size(),
                                          // for each vertex, the last triangle that marked it
                                          kNoIndex);
  std::uint32_t first = kNoIndex;
  for (const TrianglePair& pair : near_pairs(triangles, mean, kReach)) {
    if (pair.first != first) {
      first = pair.first;
      mark_neighbourhood(rings, triangles[first], first, neighbour_of);
    }
    const Triangle& other = triangles[pair.second];
    if (std::ranges::none_of(other, [&](std::uint32_t v) { return neighbour_of[v] == first; })) {
      pairs.push_back(pair);
    }
  }
  return pairs;
}

}  // namespace

ProxySkin::ProxySkin(std::vector<Triangle> triangles, const Positions& mean,
                     const std::vector<Positions>& heads)
    : triangles_(std::move(triangles)), pairs_(facing_pairs(triangles_, mean)) {
  for (const Positions& head : heads) heads_.push_back(target(head));
}

ProxySkin::Target ProxySkin::target(const Positions& samples) const {
  return {TargetTriangles(triangles_, samples),
          NewIntersections(triangles_, samples.rows(), intersecting(triangles_, samples, pairs_))};
}

Index ProxySkin::intersecting_triangles(const Positions& samples, const Target& target) const {
  return target.intersections.count(intersecting(triangles_, samples, pairs_));
}

}  // namespace crowdface
