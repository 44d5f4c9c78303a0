// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/point_blocks.h"

#include <algorithm>

namespace crowdface {

PointBlocks::PointBlocks(Index dimensions)
    : dimensions_((dimensions + kChunk - 1) / kChunk * kChunk) {}

void PointBlocks::add(Index number, const float* values) {
  const Index lane = size() % kLanes;
  if (lane == 0) values_.resize(values_.size() + static_cast<std::size_t>(dimensions_ * kLanes));
  float* block = values_.data() + size() / kLanes * dimensions_ * kLanes;
  for (Index d = 0; d < dimensions_; ++d) block[d * kLanes + lane] = values[d];
  numbers_.push_back(number);
}

void PointBlocks::clear() {
  numbers_.clear();
  values_.clear();
}

std::vector<float> PointBlocks::padded(const Eigen::VectorXf& query) const {
  std::vector<float> values(static_cast<std::size_t>(dimensions_), 0.F);
  std::copy(query.data(), query.data() + query.size(), values.begin());
  return values;
}

PointBlocks::Lanes PointBlocks::squared_distances(const std::vector<float>& query, Index block,
                                                  float bound) const {
  const float* values = values_.data() + block * dimensions_ * kLanes;
  Lanes sums = {};
  for (Index chunk = 0; chunk < dimensions_; chunk += kChunk) {
    for (Index d = chunk; d < chunk + kChunk; ++d) {
      const float q = query[static_cast<std::size_t>(d)];
      const float* row = values + d * kLanes;
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const float difference = q - row[lane];
        sums[lane] += difference * difference;
      }
    }
    int within = 0;  // sums only grow
    for (const float sum : sums) within += sum <= bound ? 1 : 0;
    if (within == 0) {
      sums.fill(HUGE_VALF);
      return sums;
    }
  }
  return sums;
}

void PointBlocks::search(const std::vector<float>& query, Index block, Index begin, Index end,
                         NearestPoint& best) const {
  const Lanes sums =
      squared_distances(query, block, static_cast<float>(std::min(best.squared, 1e30)));
  const Index last = std::min(kLanes, size() - block * kLanes);
  for (Index lane = 0; lane < last; ++lane) {
    const Index number = numbers_[static_cast<std::size_t>(block * kLanes + lane)];
    if (number < begin || number >= end) continue;
    best.meet(number, static_cast<double>(sums[static_cast<std::size_t>(lane)]));
  }
}

}  // namespace crowdface
