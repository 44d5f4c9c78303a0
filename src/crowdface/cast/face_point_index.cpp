// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_point_index.h"

#include <algorithm>

namespace crowdface {

PointBlocks::PointBlocks(Index dimensions)
    : dimensions_((dimensions + kChunk - 1) / kChunk * kChunk) {}

void PointBlocks::add(const Eigen::VectorXf& point) {
  const Index lane = size_ % kLanes;
  if (lane == 0) values_.resize(values_.size() + static_cast<std::size_t>(dimensions_ * kLanes));
  float* block = values_.data() + size_ / kLanes * dimensions_ * kLanes;
  for (Index d = 0; d < point.size(); ++d) block[d * kLanes + lane] = point[d];
  ++size_;
}

PointBlocks::Hit PointBlocks::nearest(const Eigen::VectorXf& query, double limit, Index begin,
                                      Index end) const {
  Hit best{-1, limit};
  std::vector<float> padded(static_cast<std::size_t>(dimensions_), 0.F);
  std::copy(query.data(), query.data() + query.size(), padded.begin());
  for (Index block = begin / kLanes; block * kLanes < end; ++block) {
    const float* values = values_.data() + block * dimensions_ * kLanes;
    float sums[kLanes] = {};
    bool near = true;
    for (Index chunk = 0; near && chunk < dimensions_; chunk += kChunk) {
      for (Index d = chunk; d < chunk + kChunk; ++d) {
        const float q = padded[static_cast<std::size_t>(d)];
        const float* row = values + d * kLanes;
        for (Index lane = 0; lane < kLanes; ++lane) {
          const float difference = q - row[lane];
          sums[lane] += difference * difference;
        }
      }
      const auto bound = static_cast<float>(std::min(best.squared, 1e30));
      int below = 0;  // sums only grow
      for (const float sum : sums) below += sum <= bound ? 1 : 0;
      near = below > 0;
    }
    if (!near) continue;
    const Index first = std::max(begin - block * kLanes, Index{0});
    const Index last = std::min(end - block * kLanes, kLanes);
    for (Index lane = first; lane < last; ++lane) {
      const auto squared = static_cast<double>(sums[lane]);
      if (squared < best.squared) best = {block * kLanes + lane, squared};
    }
  }
  return best;
}

void FacePointIndex::add(const FaceSpace::Point& point) {
  as_built_.add(point.as_built);
  unit_.add(point.unit);
  extrapolated_ = extrapolated_ || point.as_built != point.unit;
}

FacePointIndex::Nearest FacePointIndex::nearest(const FaceSpace::Point& point, double limit_mm,
                                                Index begin, Index end) const {
  if (end < 0) end = size();
  PointBlocks::Hit hit = as_built_.nearest(point.as_built, limit_mm * limit_mm, begin, end);
  if (extrapolated_ || point.as_built != point.unit) {
    const PointBlocks::Hit other = unit_.nearest(point.unit, hit.squared, begin, end);
    if (other.point >= 0) hit = other;
  }
  if (hit.point < 0) return {};
  return {hit.point, std::sqrt(hit.squared)};
}

}  // namespace crowdface
