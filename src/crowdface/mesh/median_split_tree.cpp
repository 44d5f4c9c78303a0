// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/median_split_tree.h"

#include <algorithm>
#include <span>
#include <utility>

namespace crowdface {
namespace {

/// The axis along which the points extend farthest; the first axis if several extents are equal.
Index widest_axis(const MedianSplitTree::Points& points, std::span<const std::uint32_t> rows) {
  Index widest = 0;
  double width = -1;
  for (Index axis = 0; axis < points.cols(); ++axis) {
    double low = points(rows[0], axis), high = low;
    for (const std::uint32_t row : rows) {
      low = std::min(low, points(row, axis));
      high = std::max(high, points(row, axis));
    }
    if (high - low > width) {
      width = high - low;
      widest = axis;
    }
  }
  return widest;
}

void add_nodes(MedianSplitTree& tree, const MedianSplitTree::Points& points,
               std::uint32_t leaf_size, std::uint32_t begin, std::uint32_t end) {
  const std::size_t node = tree.nodes.size();
  tree.nodes.push_back({begin, end, 0});
  if (end - begin <= leaf_size) return;
  const Index axis = widest_axis(points, std::span(tree.order).subspan(begin, end - begin));
  const std::uint32_t leaves = (end - begin + leaf_size - 1) / leaf_size;
  const std::uint32_t middle = begin + (leaves + 1) / 2 * leaf_size;
  const auto at = [&](std::uint32_t place) { return tree.order.begin() + place; };
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(points(a, axis), a) < std::pair(points(b, axis), b);
  });
  add_nodes(tree, points, leaf_size, begin, middle);
  tree.nodes[node].second_child = static_cast<std::uint32_t>(tree.nodes.size());
  add_nodes(tree, points, leaf_size, middle, end);
}

}  // namespace

MedianSplitTree::MedianSplitTree(std::vector<std::uint32_t> rows, const Points& points,
                                 std::uint32_t leaf_size)
    : order(std::move(rows)) {
  if (!order.empty())
    add_nodes(*this, points, leaf_size, 0, static_cast<std::uint32_t>(order.size()));
}

}  // namespace crowdface
