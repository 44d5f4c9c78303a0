// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/proximity_joiner.h"

#include <algorithm>
#include <utility>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

constexpr std::uint32_t kMaxInLeaf = 8;

}  // namespace

ProximityJoiner::ProximityJoiner(const Positions& points, std::vector<std::uint32_t> rows,
                                 const std::vector<std::uint32_t>& components, DisjointSets& groups)
    : points_(points),
      components_(components),
      groups_(groups),
      tree_(std::move(rows), points, kMaxInLeaf),
      boxes_(tree_.nodes.size()),
      groups_of_nodes_(tree_.nodes.size(), kNoIndex) {
  for (std::size_t n = tree_.nodes.size(); n-- > 0;) {
    for (const std::uint32_t row : rows_of(n)) boxes_[n].extend(row3(points_, row));
    groups_of_nodes_[n] = common_group(n);
  }
}

std::span<const std::uint32_t> ProximityJoiner::rows_of(std::size_t n) const {
  const auto& [begin, end, second] = tree_.nodes[n];
  return std::span(tree_.order).subspan(begin, end - begin);
}

void ProximityJoiner::join_near(const Eigen::Vector3d& place, double reach,
                                std::uint32_t component) {
  if (!boxes_.empty()) join_near(0, place, reach, component);
}

void ProximityJoiner::join_near(std::size_t n, const Eigen::Vector3d& place, double reach,
                                std::uint32_t component) {
  // The distance to the box is computed with the same arithmetic as the distances to its points
  // below. So rounding cannot make the box farther away than one of its points.
  if (boxes_[n].exteriorDistance(place) > reach) return;
  std::uint32_t& only = groups_of_nodes_[n];
  if (only != kNoIndex && groups_.root(only) == groups_.root(component)) return;
  if (tree_.nodes[n].is_leaf()) {
    for (const std::uint32_t row : rows_of(n)) {
      const double distance = (row3(points_, row) - place).norm();
      if (distance <= reach) groups_.join(component, components_[row]);
    }
  } else {
    join_near(n + 1, place, reach, component);
    join_near(tree_.nodes[n].second_child, place, reach, component);
  }
  if (only == kNoIndex) only = common_group(n);
}

std::uint32_t ProximityJoiner::common_group(std::size_t n) {
  const MedianSplitTree::Node& node = tree_.nodes[n];
  if (!node.is_leaf()) {
    const std::uint32_t a = groups_of_nodes_[n + 1], b = groups_of_nodes_[node.second_child];
    const bool one = a != kNoIndex && b != kNoIndex && groups_.root(a) == groups_.root(b);
    return one ? a : kNoIndex;
  }
  const std::uint32_t first = components_[tree_.order[node.begin]];
  const bool one = std::ranges::all_of(rows_of(n), [&](std::uint32_t row) {
    return groups_.root(components_[row]) == groups_.root(first);
  });
  return one ? first : kNoIndex;
}

}  // namespace crowdface
