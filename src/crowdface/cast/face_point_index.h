// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "crowdface/cast/face_space.h"

namespace crowdface {

/// Points in blocks of sixteen, coordinate by coordinate, so that a query meets sixteen of them at
/// a time; sums over the leading coordinates, where faces differ most, rule nearly all of them out.
class PointBlocks {
 public:
  explicit PointBlocks(Index dimensions);
  void add(const Eigen::VectorXf& point);
  Index size() const { return size_; }

  struct Hit {
    Index point = -1;  ///< -1: none
    double squared = HUGE_VAL;
  };
  /// The nearest of points [begin, end) whose squared distance is below `limit`; of equally near
  /// ones the first. The bits do not depend on what else is stored.
  Hit nearest(const Eigen::VectorXf& query, double limit, Index begin, Index end) const;

 private:
  static constexpr Index kLanes = 16;
  static constexpr Index kChunk = 16;  ///< coordinates between two looks at the sums

  Index dimensions_;
  Index size_ = 0;
  std::vector<float> values_;  ///< block, coordinate, lane
};

/// Faces that can be asked which of them is nearest.
class FacePointIndex {
 public:
  explicit FacePointIndex(Index dimensions) : as_built_(dimensions), unit_(dimensions) {}

  void add(const FaceSpace::Point& point);
  Index size() const { return as_built_.size(); }

  struct Nearest {
    Index face = -1;  ///< -1: none within the limit
    double mm = HUGE_VAL;
  };
  /// The nearest of the first `end` faces (of all, if less than 0), if it is nearer than `limit_mm`.
  Nearest nearest(const FaceSpace::Point& point, double limit_mm = HUGE_VAL, Index begin = 0,
                  Index end = -1) const;

 private:
  PointBlocks as_built_, unit_;
  bool extrapolated_ = false;  ///< whether any face differs from its unit variant
};

}  // namespace crowdface
