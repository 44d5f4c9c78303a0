// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_point_index.h"

namespace crowdface {

void FacePointIndex::add(const FaceSpace::Point& point) {
  as_built_.add(point.as_built);
  unit_.add(point.unit);
  extrapolated_ = extrapolated_ || point.as_built != point.unit;
}

FacePointIndex::Nearest FacePointIndex::nearest(const FaceSpace::Point& point, double limit_mm,
                                                Index begin, Index end, double enough_mm) const {
  if (end < 0) end = size();
  const double enough = enough_mm * enough_mm;
  NearestPoint hit = as_built_.nearest(point.as_built, limit_mm * limit_mm, begin, end, enough);
  const bool done = hit.point >= 0 && hit.squared < enough;
  if (!done && (extrapolated_ || point.as_built != point.unit)) {
    const NearestPoint other = unit_.nearest(point.unit, hit.squared, begin, end, enough);
    if (other.point >= 0) hit = other;
  }
  if (hit.point < 0) return {};
  return {hit.point, std::sqrt(hit.squared)};
}

}  // namespace crowdface
