// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "crowdface/cast/heads_at_samples.h"
#include "crowdface/cast/span_basis.h"

namespace crowdface {

/// The parts of a face space that take long to compute.
struct FaceSpaceTables {
  /// #levels by #modes: the coefficient of each mode (see smoothing_displacement_modes) at each
  /// smoothing level, divided by the mode's largest absolute coefficient
  FloatRows level_coefficients;
  /// 3·#functions by #P. Each face is a linear combination of the coordinate functions. Each row
  /// has the coefficients of the x, y or z component of one coordinate function, in an orthonormal
  /// basis of P scalar functions on the skin.
  FloatRows basis_coefficients;
  /// The D principal directions of a set of aligned faces, #D by 3·#P. Each row is one principal
  /// direction: its x, y and z components, one after the other, each given by coefficients in the
  /// basis of P functions.
  FloatRows principal_directions;
  /// For each region, the matrix of the region's metric, #D by #D; see find_region_metrics. Empty
  /// if there is only one region.
  std::vector<FloatRows> region_metrics;
};

/// A Euclidean space in which each face is a point. Points are computed from recipes alone, so
/// distances need no meshes. Each face is aligned rigidly to the mean head, which gives nearly the
/// same distances as aligning each pair of faces (docs/method.md). The straight-line distance
/// between two points is the root mean square distance over the face in millimetres.
class FaceSpace {
 public:
  /// The point of a face in two variants: with the extrapolation factors of the face's recipe, and
  /// with all extrapolation factors 1. The second variant is needed because two faces that differ
  /// only in extrapolation are the same person.
  struct Point {
    /// the face's coordinates with the extrapolation factors of the recipe, #dimensions
    Eigen::VectorXf coordinates_with_extrapolation;
    /// the face's coordinates with all extrapolation factors 1, #dimensions
    Eigen::VectorXf coordinates_without_extrapolation;
  };

  /// \param weights  one weight per sample, from sample_weights. Samples of weight zero are
  ///                 ignored.
  /// \param bands    Number of bands of detail in each region. With more bands, faces can differ in
  ///                 more ways.
  FaceSpace(HeadsAtSamples heads, const std::vector<double>& weights, std::size_t bands = 1);
  /// Restores a face space from `tables()`, computed from the same heads and weights.
  ///
  /// \pre `have_matching_sizes(tables, heads)`.
  FaceSpace(HeadsAtSamples heads, const std::vector<double>& weights, FaceSpaceTables tables);

  /// Returns whether the sizes of the tables fit these heads.
  static bool have_matching_sizes(const FaceSpaceTables& tables, const HeadsAtSamples& heads);
  const FaceSpaceTables& tables() const { return tables_; }

  /// Returns the point of a recipe's face.
  Point point(const Recipe& recipe) const;
  /// Returns the points of several recipes. Faster than separate calls of `point`.
  std::vector<Point> points(std::span<const Recipe* const> recipes) const;
  /// Returns the point of an input head or, if faces may be mirrored, of a head's mirror image: the
  /// mirror images have the numbers from head_count() on. Heads are not extrapolated, so the point
  /// has the same coordinates with and without extrapolation.
  Point head_point(Index head) const;

  Index dimensions() const { return tables_.principal_directions.rows() + 1; }
  Index head_count() const { return static_cast<Index>(heads_.heads.size()); }
  /// Returns the number of heads, including mirror images if there are any.
  Index head_point_count() const { return mirror_variant_count() * head_count(); }
  const HeadsAtSamples& heads_at_samples() const { return heads_; }

  /// Returns the root mean square distance between two faces in mm: the smaller of the distances
  /// with and without extrapolation.
  static double distance(const Point& a, const Point& b);
  /// A point, and one region's metric multiplied by the point's coordinates.
  struct RegionPoint {
    const Point* point = nullptr;  ///< the point of a face in the face space
    /// the region's metric multiplied by the point's coordinates with and without extrapolation,
    /// #dimensions each; empty if there is only one region
    Eigen::VectorXf metric_times_coordinates_with_extrapolation,
        metric_times_coordinates_without_extrapolation;
  };
  /// Prepares a point for calls of `region_distance`.
  RegionPoint region_point(const Point& point, Index region) const;
  /// Returns the distance between two faces over one region, after the whole faces are aligned.
  double region_distance(const RegionPoint& a, const RegionPoint& b, Index region) const;

  /// Returns the region's fraction of the face's surface area; 1 if the region is the only one.
  double region_area_fraction(Index region) const {
    return region_area_fractions_.empty()
               ? 1
               : region_area_fractions_[static_cast<std::size_t>(region)];
  }

  /// Returns the distances between all heads, #heads by #heads, in mm.
  Eigen::MatrixXd head_distances() const;

 private:
  /// The coefficients of a face in the basis of P functions, 3 by #P: a row for each of x, y and z.
  using Shape = Eigen::Matrix<float, 3, Eigen::Dynamic, Eigen::RowMajor>;

  struct FunctionOrder;  ///< the order of the coordinate functions; see face_space.cpp

  /// Returns 2 if each head has a mirror image (the mirror images are the heads from number
  /// head_count() on), otherwise 1.
  Index mirror_variant_count() const { return heads_.mirror_images == nullptr ? 1 : 2; }
  /// Returns the data that contain the head with this number. If the number is below head_count(),
  /// these are the data of the unmirrored heads, otherwise the data of the mirror images.
  const HeadsAtSamples& heads_at_samples_containing(Index head) const {
    return head < head_count() ? heads_ : *heads_.mirror_images;
  }
  /// Returns the number of coordinate functions.
  std::size_t function_count() const {
    return static_cast<std::size_t>(tables_.basis_coefficients.rows() / 3);
  }
  /// Returns the index of a head or, for a mirror image, of the mirrored head.
  std::size_t unmirrored_index(Index head) const {
    return static_cast<std::size_t>(head % head_count());
  }
  /// Returns the index of the i-th sample with nonzero weight.
  Index sample_at(Index i) const { return nonzero_weight_samples_[static_cast<std::size_t>(i)]; }
  /// Stores the samples with nonzero weight, and the square roots of their weights.
  void choose_nonzero_weight_samples(const std::vector<double>& weights);
  /// Finds a few modes that approximate how smoothing displaces the heads at all levels. Consider a
  /// matrix with one row per smoothing level. A row has one entry for each head, coordinate (x, y
  /// or z) and sample: the displacement of the sample times √w, where w is the weight of the
  /// sample. The modes are an orthonormal basis of these rows. So the displacements at each level
  /// are a linear combination of the modes, and coordinate functions are needed for the modes only,
  /// not for each level.
  SpanBasis smoothing_displacement_modes() const;
  /// Subtracts from a scalar function the function's weighted mean over the samples. Then writes,
  /// for each sample, the function's value times √w, where w is the weight of the sample. (Rigid
  /// alignment would remove the mean anyway.)
  template <class Value>
  void write_centred_values(const Value& value, float* row) const;
  /// Returns the coordinate functions at the samples, 3·#functions by #S; see FaceSpaceTables.
  ///
  /// \param modes  orthonormal basis of the detail that smoothing removes from the heads
  FloatRows coordinate_functions(const SpanBasis& modes, const std::vector<float>& max_coefficients,
                                 const FunctionOrder& order) const;
  /// Finds P orthonormal scalar functions on the samples such that each coordinate (x, y, z) of
  /// each face is a linear combination of these functions. A 3 by #P matrix of coefficients then
  /// represents a face. The distance between two such matrices is the distance between the samples
  /// of the two faces, and rotating a matrix rotates the face.
  ///
  /// Every face is a linear combination of the heads and of displacement fields. A displacement
  /// field is the displacement of one head by smoothing, multiplied by the weights of one region.
  /// The basis functions span the coordinates of all heads and all displacement fields.
  ///
  /// \return  The functions, #P by #S.
  FloatRows compute_basis_functions();
  /// Makes random faces, and computes their principal directions. In each region, the detail of
  /// these faces is divided into `bands` bands.
  void find_principal_directions(std::size_t bands);
  /// Finds the metric M_k of each region k. For two points x and y of faces in the span of the
  /// principal directions, (x − y)ᵀ M_k (x − y) = Σ_s w_s α_k(s) d(s)², where w_s is the weight of
  /// sample s, α_k(s) is the weight of region k at sample s, and d(s) is the distance between the
  /// two faces at sample s. M_k = V G_k Vᵀ, where the rows of V are the principal directions, G_k =
  /// U diag(α_k) Uᵀ, and U holds the values of the basis functions at the samples, times √w_s.
  void find_region_metrics(const FloatRows& basis);
  void compute_region_area_fractions();
  /// Transposes the principal directions, and pads them with zeros to whole SIMD vectors.
  void transpose_directions();
  /// Computes the coefficients of a face with respect to the coordinate functions, multiplies them
  /// by a factor, and adds the products to `to`.
  ///
  /// \param extrapolation  whether the extrapolation factors of the recipe apply, or all
  ///                       extrapolation factors are 1.
  /// \param orientation    0: the unmirrored face; 1: its mirror image.
  /// \param to             an array with one sum for each coordinate function, in the order of
  ///                       FunctionOrder.
  void add_coefficients(const Recipe& recipe, Extrapolation extrapolation, Index orientation,
                        double factor, float* to) const;
  /// Returns the coefficients of a recipe's face with respect to the coordinate functions. If the
  /// recipe mirrors the face, these are the coefficients of the mirrored face.
  std::vector<float> coefficients(const Recipe& recipe,
                                  Extrapolation extrapolation = Extrapolation::kAsGiven) const;
  /// Returns the coefficients of a head with respect to the coordinate functions.
  ///
  /// \param head  number of a head, or (from head_count() on) of the mirror image of a head.
  std::vector<float> head_coefficients(Index head) const;
  /// Aligns each face rigidly to the mean head, and subtracts the mean head. Returns one row per
  /// face, #faces by 3·#P: the coefficients of the difference in the basis of P functions, for x, y
  /// and z.
  ///
  /// \param coefficients  the coefficients of all faces with respect to the coordinate functions,
  ///                      one face after the other.
  FloatRows aligned_deviations(const std::vector<float>& coefficients) const;
  /// Rotates a shape to the best fit with the mean head, and subtracts the mean head.
  void align_and_subtract_mean(Eigen::Map<Shape> shape) const;
  /// Aligns each face rigidly to the mean head, and returns the face's coordinates along the
  /// principal directions, #dimensions for each face.
  ///
  /// \param coefficients  the coefficients of all faces with respect to the coordinate functions,
  ///                      one face after the other.
  std::vector<Eigen::VectorXf> coordinates(const std::vector<float>& coefficients) const;

  HeadsAtSamples heads_;
  std::vector<Index> nonzero_weight_samples_;  ///< indices of the samples with nonzero weight
  Eigen::VectorXf weight_square_roots_;        ///< √w of each sample in `nonzero_weight_samples_`
  FaceSpaceTables tables_;
  Shape mean_shape_;  ///< coefficients of the mean head in the basis
  /// the transpose of FaceSpaceTables::principal_directions (one principal direction per column),
  /// padded with columns of zeros to a multiple of 16 columns
  FloatRows directions_transposed_;
  /// for each region, its fraction of the face's surface area; empty if there is only one region
  std::vector<double> region_area_fractions_;
};

}  // namespace crowdface
