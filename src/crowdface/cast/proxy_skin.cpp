// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/proxy_skin.h"

#include <algorithm>

namespace crowdface {
namespace {

/// Margin by which the bounding boxes of the mean head's triangles grow on all sides. Two triangles
/// are checked for intersection only if the enlarged boxes overlap.
constexpr double kPairMarginMm = 3;  // in mm
/// Triangles at most this many edges apart count as neighbours. The intersection check skips
/// neighbours, because the check for flips already detects folds between neighbours.
constexpr int kNeighbourEdges = 3;

/// Sets `marks` to `mark` at all vertices that are at most kNeighbourEdges edges away from a
/// triangle.
void mark_neighbourhood(const Adjacency& adjacency, const Triangle& t, std::uint32_t mark,
                        std::vector<std::uint32_t>& marks) {
  std::vector<std::uint32_t> reached(t.begin(), t.end());
  for (const std::uint32_t vertex : t) marks[vertex] = mark;
  std::size_t begin = 0;
  for (int e = 0; e < kNeighbourEdges; ++e) {
    const std::size_t end = reached.size();
    for (; begin < end; ++begin) {
      for (const std::uint32_t next : adjacency.items_of(reached[begin])) {
        if (marks[next] == mark) continue;
        marks[next] = mark;
        reached.push_back(next);
      }
    }
  }
}

/// Returns the pairs of triangles that lie near each other on the mean head, without the pairs that
/// are neighbours (see kNeighbourEdges).
std::vector<TrianglePair> nearby_non_adjacent_pairs(const std::vector<Triangle>& triangles,
                                                    const Positions& mean) {
  const Adjacency adjacency = build_adjacency(topology_of(triangles, mean.rows()));
  std::vector<TrianglePair> pairs;
  // For each vertex: the last triangle, of those that the loop has visited so far as `first`, whose
  // neighbourhood contains the vertex.
  std::vector<std::uint32_t> last_triangle_near(static_cast<std::size_t>(mean.rows()), kNoIndex);
  std::uint32_t first = kNoIndex;
  for (const TrianglePair& pair : near_pairs(triangles, mean, kPairMarginMm)) {
    if (pair.first != first) {
      first = pair.first;
      mark_neighbourhood(adjacency, triangles[first], first, last_triangle_near);
    }
    const Triangle& other = triangles[pair.second];
    if (std::ranges::none_of(other,
                             [&](std::uint32_t v) { return last_triangle_near[v] == first; })) {
      pairs.push_back(pair);
    }
  }
  return pairs;
}

}  // namespace

ProxySkin::ProxySkin(std::vector<Triangle> triangles, const Positions& mean,
                     const std::vector<Positions>& heads)
    : triangles_(std::move(triangles)), nearby_pairs_(nearby_non_adjacent_pairs(triangles_, mean)) {
  for (const Positions& head : heads)
    reference_skins_of_heads_.push_back(make_reference_skin(head));
}

ProxySkin::ReferenceSkin ProxySkin::make_reference_skin(const Positions& samples) const {
  return {TargetTriangles(triangles_, samples),
          NewIntersections(triangles_, samples.rows(),
                           intersecting_pairs(triangles_, samples, nearby_pairs_))};
}

Index ProxySkin::count_newly_intersecting_triangles(const Positions& samples,
                                                    const ReferenceSkin& reference) const {
  return reference.intersections.count(intersecting_pairs(triangles_, samples, nearby_pairs_));
}

}  // namespace crowdface
