// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/grouping.h"

#include <algorithm>
#include <utility>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

constexpr std::uint32_t kMostInLeaf = 8;

}  // namespace

GroupingTree::GroupingTree(const Positions& points, std::vector<std::uint32_t> rows,
                           const std::vector<std::uint32_t>& components, Grouping& groups)
    : points_(points), rows_(std::move(rows)), components_(components), groups_(groups) {
  if (!rows_.empty()) build(0, static_cast<std::uint32_t>(rows_.size()));
}

void GroupingTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto n = static_cast<std::uint32_t>(nodes_.size());
  Eigen::AlignedBox3d box;
  for (std::uint32_t i = begin; i < end; ++i) box.extend(row3(points_, rows_[i]));
  nodes_.push_back({box, begin, end});
  if (end - begin > kMostInLeaf) {
    Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(rows_.begin() + begin, rows_.begin() + middle, rows_.begin() + end,
                     [&](auto a, auto b) { return points_(a, axis) < points_(b, axis); });
    build(begin, middle);
    nodes_[n].second = static_cast<std::uint32_t>(nodes_.size());
    build(middle, end);
  }
  nodes_[n].component = only_group(n);
}

void GroupingTree::join_near(const Eigen::Vector3d& place, double reach, std::uint32_t component) {
  if (!nodes_.empty()) join_near(0, place, reach, component);
}

void GroupingTree::join_near(std::uint32_t n, const Eigen::Vector3d& place, double reach,
                             std::uint32_t component) {
  Node& node = nodes_[n];
  // Computed as a point's distance is below, so that rounding cannot make a box the farther one.
  if (node.box.exteriorDistance(place) > reach) return;
  if (node.component != kNoIndex && groups_.root(node.component) == groups_.root(component)) return;
  if (node.second != 0) {
    join_near(n + 1, place, reach, component);
    join_near(node.second, place, reach, component);
  } else {
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const double distance = (row3(points_, rows_[i]) - place).norm();
      if (distance <= reach) groups_.join(component, components_[rows_[i]]);
    }
  }
  if (node.component == kNoIndex) node.component = only_group(n);
}

/// A component of the group that all points of a box belong to, as far as its children know;
/// kNoIndex if there are several.
std::uint32_t GroupingTree::only_group(std::uint32_t n) {
  const Node& node = nodes_[n];
  if (node.second != 0) {
    const std::uint32_t a = nodes_[n + 1].component;
    const std::uint32_t b = nodes_[node.second].component;
    const bool one = a != kNoIndex && b != kNoIndex && groups_.root(a) == groups_.root(b);
    return one ? a : kNoIndex;
  }
  const std::uint32_t first = components_[rows_[node.begin]];
  const bool one = std::all_of(
      rows_.begin() + node.begin, rows_.begin() + node.end,
      [&](std::uint32_t row) { return groups_.root(components_[row]) == groups_.root(first); });
  return one ? first : kNoIndex;
}

}  // namespace crowdface
