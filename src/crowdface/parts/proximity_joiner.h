// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/mesh/disjoint_sets.h"
#include "crowdface/mesh/median_split_tree.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Joins components of a mesh that have points near each other, with a bounding volume hierarchy of
/// the points. A query skips each box whose points all belong to the group of the query, so that
/// the time grows little faster than the number of points, even if many points coincide.
class ProximityJoiner {
 public:
  /// The points, the components and the groups must outlive this object. Other code may also join
  /// groups while this object exists.
  /// \param points      one point per row. Only the rows listed in `rows` are read; these must be
  ///                    finite.
  /// \param rows        row indices of the points that take part; may be empty.
  /// \param components  the component of each point.
  ProximityJoiner(const Positions& points, std::vector<std::uint32_t> rows,
                  const std::vector<std::uint32_t>& components, DisjointSets& groups);

  /// Joins `component` with the component of each point at a distance of at most `reach` from
  /// `place`.
  void join_near(const Eigen::Vector3d& place, double reach, std::uint32_t component);

 private:
  /// Returns the points in a node of the tree, as row indices of `points_`.
  std::span<const std::uint32_t> rows_of(std::size_t node) const;
  /// Like the public function, but considers only the points in a node of the tree.
  void join_near(std::size_t node, const Eigen::Vector3d& place, double reach,
                 std::uint32_t component);
  /// If all points of the node belong to the same group, returns one of the group's components,
  /// which stands for the group; otherwise kNoIndex. Uses the stored values of the node's children,
  /// which may be out of date.
  std::uint32_t common_group(std::size_t node);

  const Positions& points_;
  const std::vector<std::uint32_t>& components_;
  DisjointSets& groups_;
  MedianSplitTree tree_;
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< bounding box of each node of the tree
  /// for each node: if all points of the node are known to belong to one group of components, any
  /// one component of this group, which stands for the group; otherwise kNoIndex
  std::vector<std::uint32_t> groups_of_nodes_;
};

}  // namespace crowdface
