// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/sampled_heads.h"
#include "crowdface/cast/span_basis.h"

namespace crowdface {

/// What of a face space takes long to find.
struct FaceSpaceTables {
  FloatRows levels;  ///< #levels by #modes: how much of each mode a level takes
  FloatRows
      functions;  ///< #functions by #P: what faces are sums of, in the basis of scalar functions
  FloatRows directions;            ///< #D by 3·#P: main directions of faces' aligned shapes
  std::vector<FloatRows> metrics;  ///< #regions (none of one), #D by #D, times its share
};

/// Where faces lie, computed from recipes alone: enough to tell how far apart two faces are without
/// building a mesh. Every face is aligned rigidly to the mean head, which matches pairwise alignment
/// closely (docs/casting.md), and has coordinates in a space where straight lines measure the root
/// mean square distance over the face in millimetres.
class FaceSpace {
 public:
  /// One face. Extrapolation alone makes no other person, so there are two: as built, and with
  /// every factor set to 1.
  struct Point {
    Eigen::VectorXf as_built;  ///< #dimensions
    Eigen::VectorXf unit;      ///< the same if every factor is 1
  };

  /// \param weights  #S, what each sample counts, see sample_weights; those of zero do not count.
  /// \param bands    of each region's detail: more of them differ in more ways.
  FaceSpace(SampledHeads heads, const std::vector<double>& weights, std::size_t bands = 1);
  /// The same from what `tables()` of the same heads and weights returned. \pre they fit
  FaceSpace(SampledHeads heads, const std::vector<double>& weights, FaceSpaceTables tables);

  /// Whether tables have the sizes of those of such heads.
  static bool fit(const FaceSpaceTables& tables, const SampledHeads& heads);
  const FaceSpaceTables& tables() const { return tables_; }

  Point point(const Recipe& recipe) const;
  /// An input head, whose two coordinates are one; from number head_count() on the heads' mirror images,
  /// where faces may be mirrored.
  Point head_point(Index head) const;

  Index dimensions() const { return tables_.directions.rows() + 1; }
  Index head_count() const { return static_cast<Index>(heads_.heads.size()); }
  /// The same, their mirror images included where there are some.
  Index head_point_count() const { return sides() * head_count(); }
  const SampledHeads& sampled() const { return heads_; }

  /// Root mean square over the face in mm: the smaller of the distances between the faces as built
  /// and with factors of 1.
  static double distance(const Point& a, const Point& b);
  /// A point and what one region's metric makes of it.
  struct RegionPoint {
    const Point* point = nullptr;
    Eigen::VectorXf as_built, unit;  ///< the metric times the point's
  };
  RegionPoint in_region(const Point& point, Index region) const;
  /// The same over one region alone, the faces aligned as wholes.
  double region_distance(const RegionPoint& a, const RegionPoint& b, Index region) const;

  /// How much of the face's area a region has, 0 … 1; 1 if it is the only one.
  double region_share(Index region) const {
    return region_shares_.empty() ? 1 : region_shares_[static_cast<std::size_t>(region)];
  }

  /// Distances between all heads, #heads by #heads, in mm.
  Eigen::MatrixXd head_distances() const;

 private:
  /// A face as a combination of the basis of scalar functions, #P by 3, not yet aligned.
  using Shape = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

  struct FunctionRows;

  /// The heads, and their mirror images where there are some: heads from number head_count() on.
  Index sides() const { return heads_.image == nullptr ? 1 : 2; }
  const SampledHeads& side_of(Index head) const {
    return head < head_count() ? heads_ : *heads_.image;
  }
  std::size_t in_side(Index head) const { return static_cast<std::size_t>(head % head_count()); }
  /// The sample behind row i of what counts.
  Index sample_at(Index i) const { return counting_[static_cast<std::size_t>(i)]; }
  void choose_counting(const std::vector<double>& weights);
  SpanBasis level_modes() const;
  template <class Value>
  void put_function(const Value& value, float* row) const;
  FloatRows functions(const SpanBasis& modes, const std::vector<float>& peaks,
                      const FunctionRows& rows) const;
  FloatRows find_functions();
  void place_heads_and_fields();
  void find_directions(std::size_t bands);
  void find_region_metrics(const FloatRows& basis);
  void find_region_shares();
  Shape shape_of(const Recipe& recipe, Extrapolation extrapolation) const;
  Shape shape_in_side(const Recipe& recipe, Extrapolation extrapolation, Index side) const;
  std::vector<float> aligned(const Shape& shape) const;
  Eigen::VectorXf coordinates(const Shape& shape) const;
  const float* field(std::size_t region, Index head, Index row) const;

  SampledHeads heads_;
  std::vector<Index> counting_;  ///< samples that count in a distance
  Eigen::VectorXf roots_;        ///< √w of each
  FaceSpaceTables tables_;
  Shape mean_shape_;           ///< #P by 3
  std::vector<Shape> shapes_;  ///< of the heads of all sides
  std::vector<float> fields_;  ///< α_k (S_L x_h − x_h): regions, those heads, rows, then #P by 3
  FloatRows directions_transposed_;
  std::vector<double> region_shares_;  ///< of the face's area; none of one
};

}  // namespace crowdface
