// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/triangle_tree.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

/// Triangles at a vertex of very many: all their boxes overlap, and of 60,000 the pairs took a minute and a
/// half for each face.
std::vector<bool> around_hubs(const std::vector<Triangle>& triangles, Index vertex_count) {
  constexpr std::uint32_t kMostAround = 1000;
  std::vector<std::uint32_t> around(static_cast<std::size_t>(vertex_count), 0);
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t vertex : triangle) ++around[vertex];
  }
  std::vector<bool> left_out;
  for (const Triangle& triangle : triangles) {
    left_out.push_back(std::ranges::any_of(
        triangle, [&](std::uint32_t vertex) { return around[vertex] > kMostAround; }));
  }
  return left_out;
}

/// Halves [begin, end) along the axis in which the middles of its triangles lie farthest apart.
void add_nodes(TriangleTree& tree, const std::vector<Eigen::Vector3d>& middles, std::uint32_t begin,
               std::uint32_t end) {
  const std::size_t node = tree.nodes.size();
  tree.nodes.push_back({begin, end, 0});
  if (end - begin <= TriangleTree::kLeaf) return;
  Eigen::AlignedBox3d box;
  for (std::uint32_t i = begin; i < end; ++i) box.extend(middles[tree.order[i]]);
  Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const std::uint32_t leaves = (end - begin + TriangleTree::kLeaf - 1) / TriangleTree::kLeaf;
  const std::uint32_t middle = begin + (leaves + 1) / 2 * TriangleTree::kLeaf;
  const auto at = [&](std::uint32_t place) { return tree.order.begin() + place; };
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(middles[a][axis], a) < std::pair(middles[b][axis], b);
  });
  add_nodes(tree, middles, begin, middle);
  tree.nodes[node].right = static_cast<std::uint32_t>(tree.nodes.size());
  add_nodes(tree, middles, middle, end);
}

}  // namespace

TriangleTree::TriangleTree(const std::vector<Triangle>& triangles, const Positions& positions,
                           double apart) {
  const std::vector<bool> left_out = around_hubs(triangles, positions.rows());
  std::vector<Eigen::Vector3d> middles;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    middles.emplace_back(row3(positions, a) + row3(positions, b) + row3(positions, c));
    if (apart > 0) middles.back() += 3 * apart * area_vector(positions, triangles[t]).normalized();
    if (!left_out[t]) order.push_back(t);
  }
  if (order.empty()) return;
  add_nodes(*this, middles, 0, static_cast<std::uint32_t>(order.size()));
  corners.reserve((order.size() + kLeaf - 1) / kLeaf);
  for (std::size_t l = 0; kLeaf * l < order.size(); ++l) corners.emplace_back(leaf(l), triangles);
}

}  // namespace crowdface
