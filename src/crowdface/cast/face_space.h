// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/sampled_heads.h"
#include "crowdface/cast/span_basis.h"

namespace crowdface {

/// The parts of a face space that take long to compute.
struct FaceSpaceTables {
  FloatRows levels;  ///< #levels by #modes: coefficient of each mode at each level
  /// #functions by #P: the basis of scalar functions; faces are sums of these functions
  FloatRows functions;
  FloatRows directions;  ///< #D by 3·#P: principal directions of aligned faces
  /// #regions (empty for one region), each #D by #D: the metric of the region
  std::vector<FloatRows> metrics;
};

/// A Euclidean space of faces, computed from recipes alone, so that distances need no meshes. Each
/// face is aligned rigidly to the mean head, which matches pairwise alignment closely
/// (docs/method.md). The straight-line distance of two points is the root mean square distance
/// over the face in millimetres.
class FaceSpace {
 public:
  /// The point of a face. A face that differs from another only in extrapolation is the same
  /// person, so each face has two variants: as built, and with all extrapolation factors 1.
  struct Point {
    Eigen::VectorXf as_built;        ///< #dimensions
    Eigen::VectorXf unextrapolated;  ///< #dimensions; with all extrapolation factors 1
  };

  /// \param weights  #S, from sample_weights. Samples of weight zero are ignored.
  /// \param bands    Number of bands of each region's detail. With more bands, faces differ in more
  ///                 ways.
  FaceSpace(SampledHeads heads, const std::vector<double>& weights, std::size_t bands = 1);
  /// Restores a face space from `tables()`, computed from the same heads and weights.
  ///
  /// \pre `tables_fit(tables, heads)`.
  FaceSpace(SampledHeads heads, const std::vector<double>& weights, FaceSpaceTables tables);

  /// Returns whether the tables have the right sizes for these heads.
  static bool tables_fit(const FaceSpaceTables& tables, const SampledHeads& heads);
  const FaceSpaceTables& tables() const { return tables_; }

  Point point(const Recipe& recipe) const;
  /// Returns the point of an input head; its two variants are equal. If faces may be
  /// mirrored, the heads' mirror images are numbered from head_count() on.
  Point head_point(Index head) const;

  Index dimensions() const { return tables_.directions.rows() + 1; }
  Index head_count() const { return static_cast<Index>(heads_.heads.size()); }
  /// Returns the number of heads, including mirror images if there are any.
  Index head_point_count() const { return orientation_count() * head_count(); }
  const SampledHeads& sampled_heads() const { return heads_; }

  /// Returns the root mean square distance over the face in mm: the smaller of the distance as
  /// built and the distance with all extrapolation factors 1.
  static double distance(const Point& a, const Point& b);
  /// A point, and its products with the metric of one region.
  struct RegionPoint {
    const Point* point = nullptr;
    Eigen::VectorXf as_built, unextrapolated;  ///< metric times point
  };
  RegionPoint region_point(const Point& point, Index region) const;
  /// Returns the distance over one region, after the whole faces are aligned.
  double region_distance(const RegionPoint& a, const RegionPoint& b, Index region) const;

  /// Returns the region's fraction of the face's area; 1 if it is the only region.
  double region_share(Index region) const {
    return region_shares_.empty() ? 1 : region_shares_[static_cast<std::size_t>(region)];
  }

  /// Returns the distances between all heads, #heads by #heads, in mm.
  Eigen::MatrixXd head_distances() const;

 private:
  /// A face in the basis of scalar functions, #P by 3, before alignment.
  using Shape = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

  struct FunctionRows;

  /// Returns 1, or 2 if there are mirror images, which are the heads from number head_count() on.
  Index orientation_count() const { return heads_.mirror_images == nullptr ? 1 : 2; }
  const SampledHeads& heads_in_orientation_of(Index head) const {
    return head < head_count() ? heads_ : *heads_.mirror_images;
  }
  std::size_t unmirrored_index(Index head) const {
    return static_cast<std::size_t>(head % head_count());
  }
  /// Returns the index of the sample in row i. Samples of weight zero have no row.
  Index sample_at(Index i) const { return weighted_samples_[static_cast<std::size_t>(i)]; }
  void choose_weighted_samples(const std::vector<double>& weights);
  SpanBasis level_modes() const;
  template <class Value>
  void write_function(const Value& value, float* row) const;
  FloatRows functions(const SpanBasis& modes, const std::vector<float>& peaks,
                      const FunctionRows& rows) const;
  FloatRows find_functions();
  void compute_head_shapes_and_fields();
  void find_directions(std::size_t bands);
  void find_region_metrics(const FloatRows& basis);
  void find_region_shares();
  Shape shape_of(const Recipe& recipe, Extrapolation extrapolation) const;
  Shape shape_in_orientation(const Recipe& recipe, Extrapolation extrapolation,
                             Index orientation) const;
  std::vector<float> aligned(const Shape& shape) const;
  Eigen::VectorXf coordinates(const Shape& shape) const;
  const float* field(std::size_t region, Index head, Index row) const;

  SampledHeads heads_;
  std::vector<Index> weighted_samples_;  ///< samples of nonzero weight
  Eigen::VectorXf weight_square_roots_;  ///< √w of each sample in `weighted_samples_`
  FaceSpaceTables tables_;
  Shape mean_shape_;           ///< #P by 3
  std::vector<Shape> shapes_;  ///< shapes of all heads, including mirror images
  /// α_k (S_L x_h − x_h): by region, head (including images) and row, #P by 3 each
  std::vector<float> fields_;
  FloatRows directions_transposed_;
  std::vector<double> region_shares_;  ///< fraction of the face's area; empty for one region
};

}  // namespace crowdface
