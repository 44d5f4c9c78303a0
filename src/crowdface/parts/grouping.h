// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/mesh/grouping.h"
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
  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t begin, end;            ///< of the rows
    std::uint32_t second = 0;            ///< the first child is the next node; 0: it has none
    std::uint32_t component = kNoIndex;  ///< one of its only group; kNoIndex: several were seen
  };

  void build(std::uint32_t begin, std::uint32_t end);
  void join_near(std::uint32_t node, const Eigen::Vector3d& place, double reach,
                 std::uint32_t component);
  std::uint32_t only_group(std::uint32_t node);

  const Positions& points_;
  std::vector<std::uint32_t> rows_;
  const std::vector<std::uint32_t>& components_;
  Grouping& groups_;
  std::vector<Node> nodes_;  ///< each before its children
};

}  // namespace crowdface
