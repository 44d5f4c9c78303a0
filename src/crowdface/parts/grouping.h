// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/mesh/grouping.h"
#include "crowdface/mesh/median_split_tree.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Points of components in a tree of boxes, to join components whose points lie near each other.
/// A box all of whose points are of the asking group is not looked into: so the time grows little
/// faster than the number of points, also where very many lie in one place.
class GroupingTree {
 public:
  /// \param points      rows that are not named may hold anything; the others are finite.
  /// \param rows        of the points in the tree, may be none.
  /// \param components  #points: the component of each.
  /// The points, components and groups must outlive the tree; groups may be joined elsewhere too.
  GroupingTree(const Positions& points, std::vector<std::uint32_t> rows,
               const std::vector<std::uint32_t>& components, Grouping& groups);

  /// Joins a component with those of all points that are at most `reach` away from a place.
  void join_near(const Eigen::Vector3d& place, double reach, std::uint32_t component);

 private:
  std::span<const std::uint32_t> rows_of(std::size_t node) const;
  void join_near(std::size_t node, const Eigen::Vector3d& place, double reach,
                 std::uint32_t component);
  std::uint32_t only_group(std::size_t node);

  const Positions& points_;
  const std::vector<std::uint32_t>& components_;
  Grouping& groups_;
  MedianSplitTree tree_;
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< of each node
  std::vector<std::uint32_t>
      only_groups_;  ///< of each node a component of its only group; kNoIndex: several were seen
};

}  // namespace crowdface
