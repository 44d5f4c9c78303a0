// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowdface/cast/point_blocks.h"

namespace crowdface {

/// A k-d tree (Friedman, Bentley & Finkel 1977) over the leading coordinates of points that stay.
class PointTree {
 public:
  using Index = Eigen::Index;

  PointTree(Index dimensions, const std::vector<const PointBlocks*>& points);

  const PointBlocks& points() const { return points_; }
  void search(const std::vector<float>& query, Index begin, Index end, double enough,
              NearestPoint& best) const {
    search(0, query, begin, end, enough, best);
  }

 private:
  static constexpr Index kBoxDimensions = 8;

  struct Node {
    std::array<float, kBoxDimensions> low, high;
    Index least = 0, greatest = 0;       ///< numbers of its points
    std::int32_t left = -1, right = -1;  ///< −1: a leaf
    std::int32_t block = 0, blocks = 0;  ///< of a leaf
  };
  struct Building;

  std::int32_t build(Building& building, std::size_t begin, std::size_t end);
  float squared_distance(const Node& node, const std::vector<float>& query) const;
  void search(std::int32_t node, const std::vector<float>& query, Index begin, Index end,
              double enough, NearestPoint& best) const;

  Index box_dimensions_;
  PointBlocks points_;
  std::vector<Node> nodes_;
};

/// Points that can be asked which of them is nearest, and that grow: trees whose sizes double, so that
/// a point is moved into another tree a logarithmic number of times (Bentley & Saxe 1980), and the
/// newest points beside them.
class PointTrees {
 public:
  using Index = Eigen::Index;

  explicit PointTrees(Index dimensions) : dimensions_(dimensions), newest_(dimensions) {}

  /// Their numbers count from 0.
  void add(const Eigen::VectorXf& point);
  Index size() const { return size_; }
  /// The nearest of points [begin, end) whose squared distance is below `limit`; of equally near
  /// ones the first. The bits do not depend on what else is stored.
  /// \param enough  a squared distance, not above the limit: the search ends with any point that is nearer.
  NearestPoint nearest(const Eigen::VectorXf& query, double limit, Index begin, Index end,
                       double enough = 0) const;

 private:
  Index dimensions_;
  Index size_ = 0;
  std::vector<PointTree> trees_;  ///< of older points first, each larger than the next
  PointBlocks newest_;
};

}  // namespace crowdface
