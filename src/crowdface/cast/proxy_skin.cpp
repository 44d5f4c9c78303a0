// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/proxy_skin.h"

#include <algorithm>

namespace crowdface {
namespace {

/// How near, on the mean head, parts of the skin lie that may come to pass through each other.
constexpr double kReach = 3;  // mm, for each of the two
/// Triangles that so few edges join are neighbours; what folds there is seen as a flip.
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

/// Vertices that at most `edges` edges join to a triangle.
std::vector<std::uint32_t> neighbourhood(const Rings& rings, const Triangle& t, int edges) {
  std::vector<std::uint32_t> reached(t.begin(), t.end());
  std::size_t begin = 0;
  for (int e = 0; e < edges; ++e) {
    const std::size_t end = reached.size();
    for (; begin < end; ++begin) {
      for (const std::uint32_t next : rings[reached[begin]]) {
        if (std::find(reached.begin(), reached.end(), next) == reached.end()) {
          reached.push_back(next);
        }
      }
    }
  }
  std::sort(reached.begin(), reached.end());
  return reached;
}

/// Pairs of triangles that lie near each other without being neighbours.
std::vector<TrianglePair> facing_pairs(const std::vector<Triangle>& triangles,
                                       const Positions& mean) {
  const Rings rings = rings_of(triangles, mean.rows());
  std::vector<TrianglePair> pairs;
  std::vector<std::uint32_t> around;
  std::uint32_t first = 0;
  bool known = false;
  for (const TrianglePair& pair : near_pairs(triangles, mean, kReach)) {
    if (!known || pair.first != first) {
      around = neighbourhood(rings, triangles[pair.first], kNeighbourEdges);
      first = pair.first;
      known = true;
    }
    const Triangle& other = triangles[pair.second];
    if (std::none_of(other.begin(), other.end(), [&](std::uint32_t v) {
          return std::binary_search(around.begin(), around.end(), v);
        })) {
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
