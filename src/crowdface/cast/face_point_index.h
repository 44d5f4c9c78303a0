// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "crowdface/cast/face_space.h"
#include "crowdface/cast/point_trees.h"

namespace crowdface {

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
  /// \param enough_mm  the search ends with any face that is nearer.
  Nearest nearest(const FaceSpace::Point& point, double limit_mm = HUGE_VAL, Index begin = 0,
                  Index end = -1, double enough_mm = 0) const;

 private:
  PointTrees as_built_, unit_;
  bool extrapolated_ = false;  ///< whether any face differs from its unit variant
};

}  // namespace crowdface
