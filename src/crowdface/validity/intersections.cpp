// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/intersections.h"

#include <algorithm>

namespace crowdface {

std::vector<TrianglePair> near_pairs(const std::vector<Triangle>& triangles,
                                     const Positions& positions, double margin) {
  return TriangleScene(triangles, TriangleTree(triangles, positions), positions, margin)
      .near_pairs();
}

std::vector<TrianglePair> intersecting_pairs(const std::vector<Triangle>& triangles,
                                             const Positions& positions,
                                             const std::vector<TrianglePair>& pairs) {
  std::vector<TrianglePair> found;
  std::copy_if(
      pairs.begin(), pairs.end(), std::back_inserter(found), [&](const TrianglePair& pair) {
        return triangles_intersect(positions, triangles[pair.first], triangles[pair.second]);
      });
  return found;
}

NewIntersections::NewIntersections(const std::vector<Triangle>& triangles, Index vertex_count,
                                   const std::vector<TrianglePair>& target_pairs)
    : near_target_intersection_(triangles.size(), false) {
  std::vector<bool> there(static_cast<std::size_t>(vertex_count), false);
  for (const auto& [a, b] : target_pairs) {
    for (const std::uint32_t triangle : {a, b}) {
      for (const std::uint32_t vertex : triangles[triangle]) there[vertex] = true;
    }
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    near_target_intersection_[t] =
        std::ranges::any_of(triangles[t], [&](std::uint32_t vertex) { return there[vertex]; });
  }
}

Index NewIntersections::count(const std::vector<TrianglePair>& face_pairs) const {
  std::vector<std::uint32_t> taking_part;
  for (const auto& [a, b] : face_pairs) {
    if (near_target_intersection_[a] && near_target_intersection_[b]) continue;
    taking_part.push_back(a);
    taking_part.push_back(b);
  }
  std::ranges::sort(taking_part);
  return std::unique(taking_part.begin(), taking_part.end()) - taking_part.begin();
}

}  // namespace crowdface
