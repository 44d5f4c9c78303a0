// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/point_blocks.h"

#include <algorithm>

#include "crowdface/cast/float_kernels.h"

namespace crowdface {

PointBlocks::PointBlocks(Index dimensions)
    : padded_dimensions_((dimensions + kCoordinatesPerChunk - 1) / kCoordinatesPerChunk *
                         kCoordinatesPerChunk),
      chunks_(static_cast<std::size_t>(padded_dimensions_ / kCoordinatesPerChunk)) {}

void PointBlocks::add(Index number, const float* coordinates) {
  if (size() % kLanes == 0) {
    for (auto& chunk : chunks_) chunk.resize(chunk.size() + kCoordinatesPerChunk * kLanes);
  }
  for (Index d = 0; d < padded_dimensions_; ++d) {
    chunks_[static_cast<std::size_t>(d / kCoordinatesPerChunk)][offset_in_chunk(size(), d)] =
        coordinates[d];
  }
  point_numbers_.push_back(number);
}

void PointBlocks::clear() {
  point_numbers_.clear();
  for (auto& chunk : chunks_) chunk.clear();
}

std::vector<float> PointBlocks::padded_query(const Eigen::VectorXf& query) const {
  std::vector<float> values(static_cast<std::size_t>(padded_dimensions_), 0.F);
  std::copy(query.data(), query.data() + query.size(), values.begin());
  return values;
}

std::optional<PointBlocks::Lanes> PointBlocks::squared_distances(const std::vector<float>& query,
                                                                 Index block, float bound) const {
  Lanes sums = {};
  for (Index chunk = 0; chunk < padded_dimensions_; chunk += kCoordinatesPerChunk) {
    // The sums only grow, so once all sums exceed the bound, no point of the block is within the
    // bound.
    if (!add_squares(query.data() + chunk, &chunk_of(chunk)[offset_in_chunk(block * kLanes, chunk)],
                     kCoordinatesPerChunk, bound, sums.data())) {
      return std::nullopt;
    }
  }
  return sums;
}

void PointBlocks::search(const std::vector<float>& query, Index block, Index begin, Index end,
                         NearestPoint& best) const {
  const auto sums =
      squared_distances(query, block, static_cast<float>(std::min(best.squared_distance, 1e30)));
  if (!sums) return;
  const Index last = std::min(kLanes, size() - block * kLanes);
  for (Index lane = 0; lane < last; ++lane) {
    const Index number = point_numbers_[static_cast<std::size_t>(block * kLanes + lane)];
    if (number < begin || number >= end) continue;
    best.update(number, static_cast<double>((*sums)[static_cast<std::size_t>(lane)]));
  }
}

}  // namespace crowdface
