// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "crowdface/cast/face_space.h"
#include "crowdface/cast/point_blocks.h"

namespace crowdface {

/// A k-d tree (Friedman, Bentley & Finkel 1977) over the leading coordinates of a fixed set of
/// points.
class PointTree {
 public:
  PointTree(Index dimensions, const std::vector<const PointBlocks*>& points);

  const PointBlocks& points() const { return points_; }
  void search(const std::vector<float>& query, Index begin, Index end, double enough,
              NearestPoint& best) const;

  struct Node {
    LeadingBox box;
    Index least = 0, greatest = 0;       ///< smallest and largest number of its points
    std::int32_t left = -1, right = -1;  ///< −1: leaf
    std::int32_t block = 0, blocks = 0;  ///< first block and number of blocks; leaves only
  };
  /// Visits the blocks of leaves; of two children, the one nearer to the query first.
  ///
  /// \param wanted  (squared distance, node) → whether to visit the node.
  /// \param use     Called with the number of each block.
  template <class Wanted, class Use>
  void visit(const std::vector<float>& query, const Wanted& wanted, const Use& use,
             std::size_t at = 0) const {
    const Node& node = nodes_[at];
    for (std::int32_t b = node.block; b < node.block + node.blocks; ++b) use(Index{b});
    if (node.left < 0) return;
    std::array<std::pair<float, std::size_t>, 2> children;
    for (std::size_t c = 0; c < 2; ++c) {
      const auto child = static_cast<std::size_t>(c == 0 ? node.left : node.right);
      children[c] = {nodes_[child].box.squared_distance(query), child};
    }
    if (children[1].first < children[0].first) std::swap(children[0], children[1]);
    for (const auto& [squared, child] : children) {
      if (wanted(squared, nodes_[child])) visit(query, wanted, use, child);
    }
  }

 private:
  struct Building;

  std::int32_t build(Building& building, std::size_t begin, std::size_t end);

  PointBlocks points_;
  std::vector<Node> nodes_;
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
  /// \param enough  Squared distance, at most `limit`: the search ends at any point nearer than
  ///                this.
  NearestPoint nearest(const Eigen::VectorXf& query, double limit, Index begin, Index end,
                       double enough = 0) const;

 private:
  Index dimensions_;
  Index size_ = 0;
  std::vector<PointTree> trees_;  ///< older points first; each tree is larger than the next
  PointBlocks newest_;
};

/// A set of faces with nearest-face queries.
class FacePointIndex {
 public:
  explicit FacePointIndex(Index dimensions) : as_built_(dimensions), unit_(dimensions) {}

  void add(const FaceSpace::Point& point);
  Index size() const { return as_built_.size(); }

  struct Nearest {
    Index face = -1;  ///< −1: none within the limit
    double mm = HUGE_VAL;
  };
  /// Returns the nearest of the faces [begin, end) if it is nearer than `limit_mm`.
  ///
  /// \param end        If negative, the number of faces.
  /// \param enough_mm  The search ends at any face nearer than this.
  Nearest nearest(const FaceSpace::Point& point, double limit_mm = HUGE_VAL, Index begin = 0,
                  Index end = -1, double enough_mm = 0) const;

 private:
  PointTrees as_built_, unit_;
  bool extrapolated_ = false;  ///< whether any face differs from its version with factors of 1
};

}  // namespace crowdface
