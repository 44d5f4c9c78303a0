// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace crowdface {

/// The nearest point that a search has found so far.
struct NearestPoint {
  Eigen::Index point = -1;  ///< number of the point; −1: no point was found
  double squared_distance = HUGE_VAL;

  /// Replaces the stored point by another point if the other point is nearer. Of two equally near
  /// points, keeps the point with the smaller number.
  void update(Eigen::Index other, double other_squared_distance) {
    if (other_squared_distance > squared_distance ||
        (other_squared_distance == squared_distance && (point < 0 || other > point)))
      return;
    *this = {other, other_squared_distance};
  }
};

/// Bounding box of points in their leading (first few) coordinates. If points have fewer
/// coordinates than the box, the missing coordinates are zero.
struct LeadingCoordinatesBox {
  static constexpr std::size_t kDimensions = 8;  ///< number of coordinates that the box bounds
  std::array<float, kDimensions> low, high;      ///< smallest and largest value of each coordinate

  /// Returns the squared distance from a point to the box; 0 inside the box.
  float squared_distance(const std::vector<float>& query) const {
    std::array<float, kDimensions> squared_distances_outside;
    for (std::size_t d = 0; d < kDimensions; ++d) {
      const float distance_outside = std::max(std::max(low[d] - query[d], query[d] - high[d]), 0.F);
      squared_distances_outside[d] = distance_outside * distance_outside;
    }
    float sum_of_squared_distances = 0;
    for (const float square : squared_distances_outside) sum_of_squared_distances += square;
    return sum_of_squared_distances;
  }
};

/// Points in blocks of sixteen, each point with a number that the caller of `add` chooses. A block
/// stores the first coordinates of all its points, then the second coordinates, and so on, so that
/// a query compares sixteen points at a time. In a FaceSpace, points differ most in their leading
/// coordinates, so a query rules out nearly all blocks after the leading coordinates.
class PointBlocks {
 public:
  using Index = Eigen::Index;
  static constexpr Index kLanes = 16;  ///< number of points in a block
  /// Relative tolerance for the rounding of sums in single precision. A search skips points that
  /// are farther than the best point by more than this tolerance.
  static constexpr double kRoundingTolerance = 1e-4;

  explicit PointBlocks(Index dimensions);

  /// \param coordinates  the point's coordinates, padded with zeros to padded_dimensions() values.
  void add(Index number, const float* coordinates);
  void clear();
  Index size() const { return static_cast<Index>(point_numbers_.size()); }
  /// Returns the number of coordinates of each stored point, including the zeros at the end.
  Index padded_dimensions() const { return padded_dimensions_; }
  /// Returns the number that the caller of `add` gave to a point.
  /// \param index  0 for the point that was added first.
  Index point_number(Index index) const { return point_numbers_[static_cast<std::size_t>(index)]; }
  /// Returns one coordinate of a point.
  /// \param index  0 for the point that was added first; not the number that the caller of `add`
  ///               chose
  float coordinate(Index index, Index dimension) const {
    return chunk_of(dimension)[offset_in_chunk(index, dimension)];
  }

  /// Returns the query, padded with zeros to padded_dimensions() values.
  std::vector<float> padded_query(const Eigen::VectorXf& query) const;
  using Lanes = std::array<float, kLanes>;
  /// Returns the squared distances between a query and the points of a block. Lanes without a point
  /// have arbitrary values.
  ///
  /// \return  nullopt if all distances exceed the bound.
  std::optional<Lanes> squared_distances(const std::vector<float>& query, Index block,
                                         float bound) const;
  /// Searches one block for points that are nearer than `best` and have numbers in [begin, end).
  /// The distance of a point does not depend on which other points the block contains, not even in
  /// the last bits.
  void search(const std::vector<float>& query, Index block, Index begin, Index end,
              NearestPoint& best) const;

 private:
  /// number of coordinates that are summed before the sums are compared with the bound
  static constexpr Index kCoordinatesPerChunk = 8;

  /// Returns the index of a coordinate of a point within the chunk `chunk_of(dimension)`.
  ///
  /// \param index  0 for the point that was added first.
  static std::size_t offset_in_chunk(Index index, Index dimension) {
    return static_cast<std::size_t>(
        (index / kLanes * kCoordinatesPerChunk + dimension % kCoordinatesPerChunk) * kLanes +
        index % kLanes);
  }
  /// Returns the element of `chunks_` that contains, for every point, coordinate number
  /// `dimension`.
  const std::vector<float>& chunk_of(Index dimension) const {
    return chunks_[static_cast<std::size_t>(dimension / kCoordinatesPerChunk)];
  }

  /// number of stored coordinates of each point, a multiple of kCoordinatesPerChunk
  Index padded_dimensions_;
  std::vector<Index> point_numbers_;  ///< numbers of the points, in the order of `add`
  /// For each chunk of kCoordinatesPerChunk coordinates, the values sorted by block, then
  /// coordinate, then lane.
  /// Nearly all searches of a block end in the first chunk, so the first chunks of all blocks are
  /// contiguous in memory.
  std::vector<std::vector<float>> chunks_;
};

}  // namespace crowdface
