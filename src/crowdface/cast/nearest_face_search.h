// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "crowdface/cast/face_space.h"
#include "crowdface/cast/point_blocks.h"
#include "crowdface/mesh/median_split_tree.h"

namespace crowdface {

/// A k-d tree (Friedman, Bentley & Finkel 1977) over the leading coordinates of a fixed set of
/// points.
class PointTree {
 public:
  PointTree(Index dimensions, const std::vector<const PointBlocks*>& points);

  const PointBlocks& points() const { return points_; }
  void search(const std::vector<float>& query, Index begin, Index end, double enough,
              NearestPoint& best) const;

  /// Bounds of the points of a node.
  struct Bounds {
    LeadingCoordinatesBox box;
    Index min_number, max_number;  ///< of the node's points
  };
  /// Visits the blocks of leaves. Visits the child node nearer to the query first.
  ///
  /// \param wanted  wanted(squared distance to the query, bounds): whether to visit a node.
  /// \param use     Called with the number of each block.
  template <class Wanted, class Use>
  void visit(const std::vector<float>& query, const Wanted& wanted, const Use& use,
             std::uint32_t at = 0) const {
    const MedianSplitTree::Node& node = tree_.nodes[at];
    if (node.is_leaf()) {
      for (Index block = node.begin / PointBlocks::kLanes; block * PointBlocks::kLanes < node.end;
           ++block) {
        use(block);
      }
      return;
    }
    const auto squared = [&](std::uint32_t n) { return bounds_[n].box.squared_distance(query); };
    std::pair near{squared(at + 1), at + 1}, far{squared(node.second), node.second};
    if (far.first < near.first) std::swap(near, far);
    for (const auto& [distance, child] : {near, far}) {
      if (wanted(distance, bounds_[child])) visit(query, wanted, use, child);
    }
  }

 private:
  PointBlocks points_;  ///< in the tree's order
  MedianSplitTree tree_;
  std::vector<Bounds> bounds_;  ///< #nodes: bounds of the node's points
};

/// A growing set of points with nearest-point queries: trees whose sizes double, so that each point
/// moves to a larger tree a logarithmic number of times (Bentley & Saxe 1980), and a list of the
/// newest points.
class PointTrees {
 public:
  explicit PointTrees(Index dimensions) : dimensions_(dimensions), newest_(dimensions) {}

  /// Adds a point. Points are numbered from 0.
  void add(const Eigen::VectorXf& point);
  Index size() const { return size_; }
  /// Returns the nearest of the points [begin, end) with a squared distance below `limit`; of
  /// equally near points, the first. The result's bits do not depend on the other points.
  ///
  /// \param enough  Squared distance, at most `limit`: the search ends at the first point nearer
  ///                than this.
  NearestPoint nearest(const Eigen::VectorXf& query, double limit, Index begin, Index end,
                       double enough = 0) const;

 private:
  Index dimensions_;
  Index size_ = 0;
  std::vector<PointTree> trees_;  ///< older points first; each tree is larger than the next
  PointBlocks newest_;
};

/// A set of faces with nearest-face queries.
class NearestFaceSearch {
 public:
  explicit NearestFaceSearch(Index dimensions)
      : as_built_(dimensions), unextrapolated_(dimensions) {}

  void add(const FaceSpace::Point& point);
  Index size() const { return as_built_.size(); }

  struct NearestFace {
    Index face = -1;  ///< −1: none within the limit
    double distance_mm = HUGE_VAL;
  };
  /// Returns the nearest of the faces [begin, end) if it is nearer than `limit_mm`.
  ///
  /// \param end        If negative, the number of faces.
  /// \param enough_mm  The search ends at the first face nearer than this.
  NearestFace nearest(const FaceSpace::Point& point, double limit_mm = HUGE_VAL, Index begin = 0,
                      Index end = -1, double enough_mm = 0) const;

 private:
  PointTrees as_built_, unextrapolated_;  ///< see FaceSpace::Point
  bool extrapolated_ = false;  ///< whether any face has an extrapolation factor other than 1
};

}  // namespace crowdface
