// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace crowdface {

/// The nearest point that a search has found so far.
struct NearestPoint {
  Eigen::Index point = -1;  ///< number of the point; −1: none
  double squared_distance = HUGE_VAL;

  /// Takes another point if it is nearer; of equally near points, the point with the smaller
  /// number.
  void update(Eigen::Index other, double squared) {
    if (squared > squared_distance || (squared == squared_distance && (point < 0 || other > point)))
      return;
    *this = {other, squared};
  }
};

/// Bounding box in the leading coordinates; missing coordinates are zero.
struct LeadingCoordinatesBox {
  static constexpr std::size_t kDimensions = 8;
  std::array<float, kDimensions> low, high;

  float squared_distance(const std::vector<float>& query) const {
    std::array<float, kDimensions> squares;
    for (std::size_t d = 0; d < kDimensions; ++d) {
      const float beyond = std::max(std::max(low[d] - query[d], query[d] - high[d]), 0.F);
      squares[d] = beyond * beyond;
    }
    float sum = 0;
    for (const float square : squares) sum += square;
    return sum;
  }
};

/// Numbered points in blocks of sixteen, stored coordinate by coordinate, so that a query compares
/// sixteen points at a time. The leading coordinates, in which faces differ most, rule out nearly
/// all blocks early.
class PointBlocks {
 public:
  using Index = Eigen::Index;
  static constexpr Index kLanes = 16;
  /// Relative tolerance that covers the rounding of float sums: points farther than the best by
  /// more than this are skipped.
  static constexpr double kRounding = 1e-4;

  explicit PointBlocks(Index dimensions);

  /// \param values  padded_dimensions() values.
  void add(Index number, const float* values);
  void clear();
  Index size() const { return static_cast<Index>(numbers_.size()); }
  Index padded_dimensions() const { return dimensions_; }
  /// Returns the number of a point, by the order in which points were added.
  Index number(Index at) const { return numbers_[static_cast<std::size_t>(at)]; }
  float value(Index at, Index dimension) const {
    return chunk_of(dimension)[chunk_offset(at, dimension)];
  }

  /// Returns the query with padded_dimensions() values.
  std::vector<float> padded_query(const Eigen::VectorXf& query) const;
  using Lanes = std::array<float, kLanes>;
  /// Returns the squared distances of a block's points to a query. If no distance is within the
  /// bound, all returned values are infinite. Lanes without a point have arbitrary values.
  Lanes squared_distances(const std::vector<float>& query, Index block, float bound) const;
  /// Searches one block for points with numbers in [begin, end) that are nearer than `best`. The
  /// result's bits do not depend on the other points.
  void search(const std::vector<float>& query, Index block, Index begin, Index end,
              NearestPoint& best) const;

 private:
  static constexpr Index kChunk = 16;  ///< coordinates between two checks of the sums

  /// Returns the offset of coordinate `dimension` of point `at` within its chunk.
  static std::size_t chunk_offset(Index at, Index dimension) {
    return static_cast<std::size_t>((at / kLanes * kChunk + dimension % kChunk) * kLanes +
                                    at % kLanes);
  }
  const std::vector<float>& chunk_of(Index dimension) const {
    return chunks_[static_cast<std::size_t>(dimension / kChunk)];
  }

  Index dimensions_;  ///< a multiple of kChunk
  std::vector<Index> numbers_;
  /// Chunks of kChunk coordinates: block, coordinate, lane. Nearly all searches of a block end in
  /// the first chunk, so the first chunks of all blocks are contiguous in memory.
  std::vector<std::vector<float>> chunks_;
};

}  // namespace crowdface
