// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/triangle_tree.h"

#include <algorithm>
#include <utility>

namespace crowdface {
namespace {

/// Marks the triangles at vertices with more than kMaxTrianglesAtVertex triangles. The boxes of all
/// triangles at such a vertex overlap each other: with 60,000 triangles at one vertex, the tests of
/// pairs took 90 seconds per face.
std::vector<bool> is_at_hub(const std::vector<Triangle>& triangles, Index vertex_count) {
  constexpr std::uint32_t kMaxTrianglesAtVertex = 1000;
  std::vector<std::uint32_t> around(static_cast<std::size_t>(vertex_count), 0);
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t vertex : triangle) ++around[vertex];
  }
  std::vector<bool> left_out;
  for (const Triangle& triangle : triangles) {
    left_out.push_back(std::ranges::any_of(
        triangle, [&](std::uint32_t vertex) { return around[vertex] > kMaxTrianglesAtVertex; }));
  }
  return left_out;
}

/// Builds the tree from one point per triangle: the centroid, shifted along the triangle's normal
/// by `normal_offset`. The coordinates of all points are multiplied by 3, because the sum of a
/// triangle's corners is three times the centroid.
MedianSplitTree split_triangles(const std::vector<Triangle>& triangles, const Positions& positions,
                                double normal_offset) {
  const std::vector<bool> left_out = is_at_hub(triangles, positions.rows());
  Positions middles(static_cast<Index>(triangles.size()), 3);
  std::vector<std::uint32_t> rows;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    middles.row(t) = positions.row(a) + positions.row(b) + positions.row(c);
    if (normal_offset > 0) {
      middles.row(t) +=
          3 * normal_offset * area_vector(positions, triangles[t]).normalized().transpose();
    }
    if (!left_out[t]) rows.push_back(t);
  }
  return {std::move(rows), middles, TriangleTree::kLeafSize};
}

}  // namespace

TriangleTree::TriangleTree(const std::vector<Triangle>& triangles, const Positions& positions,
                           double normal_offset)
    : MedianSplitTree(split_triangles(triangles, positions, normal_offset)) {
  corners.reserve((order.size() + kLeafSize - 1) / kLeafSize);
  for (std::size_t l = 0; kLeafSize * l < order.size(); ++l)
    corners.emplace_back(leaf(l), triangles);
}

}  // namespace crowdface
