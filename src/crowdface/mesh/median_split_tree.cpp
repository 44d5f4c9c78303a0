// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/median_split_tree.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

void add_nodes(MedianSplitTree& tree, const Positions& points, std::uint32_t leaf_size,
               std::uint32_t begin, std::uint32_t end) {
  const std::size_t node = tree.nodes.size();
  tree.nodes.push_back({begin, end, 0});
  if (end - begin <= leaf_size) return;
  Eigen::AlignedBox3d box;
  for (std::uint32_t i = begin; i < end; ++i) box.extend(row3(points, tree.order[i]));
  Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const std::uint32_t leaves = (end - begin + leaf_size - 1) / leaf_size;
  const std::uint32_t middle = begin + (leaves + 1) / 2 * leaf_size;
  const auto at = [&](std::uint32_t place) { return tree.order.begin() + place; };
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(points(a, axis), a) < std::pair(points(b, axis), b);
  });
  add_nodes(tree, points, leaf_size, begin, middle);
  tree.nodes[node].second = static_cast<std::uint32_t>(tree.nodes.size());
  add_nodes(tree, points, leaf_size, middle, end);
}

}  // namespace

MedianSplitTree::MedianSplitTree(std::vector<std::uint32_t> rows, const Positions& points,
                                 std::uint32_t leaf_size)
    : order(std::move(rows)) {
  if (!order.empty())
    add_nodes(*this, points, leaf_size, 0, static_cast<std::uint32_t>(order.size()));
}

}  // namespace crowdface
