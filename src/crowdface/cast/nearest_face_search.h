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

/// A k-d tree (Friedman, Bentley & Finkel 1977) of a fixed set of points. The tree splits by the
/// leading coordinates only.
class PointTree {
 public:
  /// \param points  blocks whose points the tree copies
  PointTree(Index dimensions, const std::vector<const PointBlocks*>& points);

  const PointBlocks& points() const { return points_; }
  /// Replaces `best` by the nearest point whose number is in [begin, end), if this point is nearer
  /// than `best`. Stops at the first point nearer than `sufficient_squared_distance`.
  void search(const std::vector<float>& query, Index begin, Index end,
              double sufficient_squared_distance, NearestPoint& best) const;

  /// The bounding box of all points of a tree node, and the smallest and the largest point number
  /// (see PointBlocks::point_number) in the node.
  struct Bounds {
    LeadingCoordinatesBox box;
    /// smallest and largest number of a point in the node
    Index min_point_number, max_point_number;
  };
  /// Visits the blocks of points in the leaves. Of two child nodes, visits the child nearer to the
  /// query first.
  ///
  /// \param is_wanted    is_wanted(d, bounds) returns whether to visit the node with these bounds.
  ///                     d is the squared distance from the query to the node's bounding box.
  /// \param visit_block  Called with the number of each visited block.
  template <class IsWanted, class VisitBlock>
  void visit(const std::vector<float>& query, const IsWanted& is_wanted,
             const VisitBlock& visit_block, std::uint32_t node_index = 0) const {
    const MedianSplitTree::Node& node = tree_.nodes[node_index];
    if (node.is_leaf()) {
      for (Index block = node.begin / PointBlocks::kLanes; block * PointBlocks::kLanes < node.end;
           ++block) {
        visit_block(block);
      }
      return;
    }
    const auto squared_distance = [&](std::uint32_t n) {
      return bounds_[n].box.squared_distance(query);
    };
    std::pair near{squared_distance(node_index + 1), node_index + 1},
        far{squared_distance(node.second_child), node.second_child};
    if (far.first < near.first) std::swap(near, far);
    for (const auto& [distance, child] : {near, far}) {
      if (is_wanted(distance, bounds_[child])) visit(query, is_wanted, visit_block, child);
    }
  }

 private:
  PointBlocks points_;  ///< all points, in the order of the tree's leaves
  MedianSplitTree tree_;
  std::vector<Bounds> bounds_;  ///< for each node, the bounds of the node's points
};

/// A growing set of points with nearest-point queries. Most points are in trees whose sizes double,
/// so that each point moves to a larger tree a logarithmic number of times (Bentley & Saxe 1980).
/// The newest points are in a list.
class GrowingPointSet {
 public:
  explicit GrowingPointSet(Index dimensions)
      : dimensions_(dimensions), newest_points_(dimensions) {}

  /// Adds a point. Points are numbered in the order in which they are added, from 0.
  void add(const Eigen::VectorXf& point);
  Index size() const { return size_; }
  /// Returns the nearest of the points with numbers in [begin, end) whose squared distance is below
  /// `limit_squared`; of equally near points, the first. The distance of the returned point does
  /// not depend on which other points the set contains, not even in the last bits.
  ///
  /// \param sufficient_squared_distance  at most `limit_squared`; the search ends at the first
  ///                                     point whose squared distance is smaller.
  NearestPoint nearest(const Eigen::VectorXf& query, double limit_squared, Index begin, Index end,
                       double sufficient_squared_distance = 0) const;

 private:
  Index dimensions_;
  Index size_ = 0;
  /// trees of all points except the newest. The first tree contains the oldest points; each tree
  /// contains more points than the next tree.
  std::vector<PointTree> trees_;
  PointBlocks newest_points_;
};

/// A set of faces with nearest-face queries.
class NearestFaceSearch {
 public:
  explicit NearestFaceSearch(Index dimensions)
      : points_with_extrapolation_(dimensions), points_without_extrapolation_(dimensions) {}

  void add(const FaceSpace::Point& point);
  Index size() const { return points_with_extrapolation_.size(); }

  struct NearestFace {
    Index face = -1;  ///< number of the face; −1: no face is within the limit
    double distance_mm = HUGE_VAL;
  };
  /// Returns the nearest of the faces with numbers in [begin, end), if this face is nearer than
  /// `limit_mm`.
  ///
  /// \param end        If negative, the number of faces.
  /// \param sufficient_distance_mm  The search ends at the first face that is nearer than this
  ///                                distance.
  NearestFace nearest(const FaceSpace::Point& point, double limit_mm = HUGE_VAL, Index begin = 0,
                      Index end = -1, double sufficient_distance_mm = 0) const;

 private:
  /// the points of the faces, with and without extrapolation; see FaceSpace::Point
  GrowingPointSet points_with_extrapolation_, points_without_extrapolation_;
  /// whether at least one face has an extrapolation factor other than 1
  bool has_extrapolated_faces_ = false;
};

}  // namespace crowdface
