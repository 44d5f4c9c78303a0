// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace crowdface {

/// The nearest point that a search has met.
struct NearestPoint {
  Eigen::Index point = -1;  ///< its number; -1: none
  double squared = HUGE_VAL;

  /// Of equally near ones the one with the smaller number counts.
  void meet(Eigen::Index other, double other_squared) {
    if (other_squared > squared || (other_squared == squared && (point < 0 || other > point)))
      return;
    *this = {other, other_squared};
  }
};

/// Where points lie in their leading coordinates; those that they do not have are zero.
struct LeadingBox {
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

/// Numbered points in blocks of sixteen, coordinate by coordinate, so that a query meets sixteen of
/// them at a time; sums over the leading coordinates, where faces differ most, rule nearly all out.
class PointBlocks {
 public:
  using Index = Eigen::Index;
  static constexpr Index kLanes = 16;
  /// What is farther than what was found by more than sums of floats can err is left out.
  static constexpr double kRounding = 1e-4;

  explicit PointBlocks(Index dimensions);

  /// \param values  as long as padded() makes them.
  void add(Index number, const float* values);
  void clear();
  Index size() const { return static_cast<Index>(numbers_.size()); }
  Index padded_dimensions() const { return dimensions_; }
  /// Those of the points, in the order in which they were added.
  Index number(Index at) const { return numbers_[static_cast<std::size_t>(at)]; }
  float value(Index at, Index dimension) const { return chunk_of(dimension)[place(at, dimension)]; }

  /// Blocks are searched for a query that is as long as theirs.
  std::vector<float> padded(const Eigen::VectorXf& query) const;
  using Lanes = std::array<float, kLanes>;
  /// Of the points of one block to a query; of all of them infinity, if none is within the bound. Lanes
  /// without a point hold anything.
  Lanes squared_distances(const std::vector<float>& query, Index block, float bound) const;
  /// Meets the points of one block with numbers in [begin, end), as far as they can be nearer.
  /// The bits do not depend on what else is stored.
  void search(const std::vector<float>& query, Index block, Index begin, Index end,
              NearestPoint& best) const;

 private:
  static constexpr Index kChunk = 16;  ///< coordinates between two looks at the sums

  /// In the chunk of that coordinate.
  static std::size_t place(Index at, Index dimension) {
    return static_cast<std::size_t>((at / kLanes * kChunk + dimension % kChunk) * kLanes +
                                    at % kLanes);
  }
  const std::vector<float>& chunk_of(Index dimension) const {
    return chunks_[static_cast<std::size_t>(dimension / kChunk)];
  }

  Index dimensions_;  ///< a multiple of kChunk
  std::vector<Index> numbers_;
  /// By kChunk coordinates each: block, coordinate, lane. Nearly all searches of a block end at the leading ones,
  /// which so lie close to each other.
  std::vector<std::vector<float>> chunks_;
};

}  // namespace crowdface
