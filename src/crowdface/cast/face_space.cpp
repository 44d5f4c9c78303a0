// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_space.h"

#include <algorithm>
#include <cmath>

#include "crowdface/cast/float_kernels.h"
#include "crowdface/cast/training_recipe.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/mesh/alignment.h"

namespace crowdface {
namespace {

/// Largest error with which span_basis may approximate smoothing displacements and coordinate
/// functions: root mean square over the face, in millimetres.
constexpr double kFieldTolerance = 0.004;
/// Largest number P of orthonormal basis functions for each orientation (unmirrored and mirrored).
constexpr Index kMaxBasisFunctions = 400;
/// How far a training face may lie outside the span of the principal directions, in millimetres.
/// The distance from the span is stored as an additional coordinate.
constexpr double kFaceTolerance = 0.05;
/// largest number of directions for each orientation (unmirrored and mirrored)
constexpr Index kMaxDirections = 192;
constexpr std::uint64_t kTrainingFaces = 1024;

double squared_distance(const Eigen::VectorXf& a, const Eigen::VectorXf& b) {
  double sum = 0;
  for (Index i = 0; i < a.size(); ++i) {
    const double d = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    sum += d * d;
  }
  return sum;
}

/// Returns whether any band of a recipe has an extrapolation factor other than 1.
bool is_extrapolated(const Recipe& recipe) {
  const auto is_extrapolated_band = [](const BandRecipe& band) { return band.extrapolation != 1; };
  return std::ranges::any_of(recipe.regions, [&](const RegionRecipe& region) {
    return is_extrapolated_band(region) ||
           std::ranges::any_of(region.finer_bands, is_extrapolated_band);
  });
}

}  // namespace

/// The order of the coordinate functions in the rows of a matrix: the mean head, then the deviation
/// of each head from the mean head, then the displacement fields. The fields are sorted by region;
/// those of a region by head; those of a head by mode.
struct FaceSpace::FunctionRowOrder {
  Index heads, modes;
  static Index of_head(Index head) { return 3 + 3 * head; }
  Index of_field(Index region_and_head, Index mode) const {
    return 3 + 3 * heads + 3 * (region_and_head * modes + mode);
  }
  Index count(Index regions) const { return of_field(regions * heads, 0); }
};

FaceSpace::FaceSpace(SampledHeads heads, const std::vector<double>& weights, std::size_t bands)
    : heads_(std::move(heads)) {
  choose_nonzero_weight_samples(weights);
  const FloatRows basis = compute_basis_functions();
  compute_head_shapes_and_fields();
  find_principal_directions(bands);
  transpose_directions();
  if (heads_.region_weights.cols() == 1) return;
  compute_region_area_fractions();
  find_region_metrics(basis);
}

FaceSpace::FaceSpace(SampledHeads heads, const std::vector<double>& weights, FaceSpaceTables tables)
    : heads_(std::move(heads)), tables_(std::move(tables)) {
  require(have_matching_sizes(tables_, heads_), "face space: tables of other heads");
  choose_nonzero_weight_samples(weights);
  compute_head_shapes_and_fields();
  transpose_directions();
  if (heads_.region_weights.cols() > 1) compute_region_area_fractions();
}

bool FaceSpace::have_matching_sizes(const FaceSpaceTables& tables, const SampledHeads& heads) {
  const std::size_t mirror_variant_count = heads.mirror_images == nullptr ? 1 : 2;
  const FunctionRowOrder rows{static_cast<Index>(mirror_variant_count * heads.heads.size()),
                              tables.level_coefficients.cols()};
  const Index regions = heads.region_weights.cols(), rank = tables.principal_directions.rows();
  return tables.level_coefficients.rows() == static_cast<Index>(heads.levels.size()) &&
         tables.basis_coefficients.rows() == rows.count(regions) &&
         tables.principal_directions.cols() == 3 * tables.basis_coefficients.cols() &&
         static_cast<Index>(tables.region_metrics.size()) == (regions > 1 ? regions : 0) &&
         std::ranges::all_of(tables.region_metrics, [&](const FloatRows& metric) {
           return metric.rows() == rank && metric.cols() == rank;
         });
}

void FaceSpace::choose_nonzero_weight_samples(const std::vector<double>& weights) {
  for (Index s = 0; s < heads_.mean.rows(); ++s) {
    if (weights[static_cast<std::size_t>(s)] > 0) nonzero_weight_samples_.push_back(s);
  }
  weight_square_roots_.resize(static_cast<Index>(nonzero_weight_samples_.size()));
  for (Index i = 0; i < weight_square_roots_.size(); ++i) {
    weight_square_roots_[i] =
        static_cast<float>(std::sqrt(weights[static_cast<std::size_t>(sample_at(i))]));
  }
}

/// Finds a few modes whose linear combinations give the displacements of all heads at all smoothing
/// levels. Displacement fields are needed for these modes only. The modes are an orthonormal basis
/// of the rows of a matrix with one row per level, and one column per head, coordinate (x, y or z)
/// and sample. An entry is the sample's displacement times √w, where w is the weight of the sample.
SpanBasis FaceSpace::smoothing_displacement_modes() const {
  const Index heads = head_point_count(), size = weight_square_roots_.size();
  const auto level_count = static_cast<Index>(heads_.levels.size());
  FloatRows levels(level_count, heads * 3 * size);
  parallel_for_each(heads, [&](Index h) {
    const Trajectory& trajectory = sampled_heads_containing(h).trajectories[unmirrored_index(h)];
    for (Index l = 0; l < level_count; ++l) {
      for (Index i = 0; i < size; ++i) {
        for (Index c = 0; c < 3; ++c) {
          const auto value = static_cast<double>(trajectory(l, 3 * sample_at(i) + c));
          levels(l, (h * 3 + c) * size + i) =
              static_cast<float>(value * heads_.mm_per_unit) * weight_square_roots_[i];
        }
      }
    }
  });
  return span_basis(std::move(levels), kFieldTolerance, level_count);
}

/// Subtracts the mean over the face from a scalar function, and writes the function's values at the
/// samples, times √w. (Rigid alignment would remove the mean anyway.)
template <class Value>
void FaceSpace::write_centred_values(const Value& value, float* row) const {
  double mean = 0;
  for (Index i = 0; i < weight_square_roots_.size(); ++i) {
    const double scaled = static_cast<double>(weight_square_roots_[i]) * value(i);
    row[i] = static_cast<float>(scaled);
    mean += static_cast<double>(weight_square_roots_[i]) * scaled;
  }
  for (Index i = 0; i < weight_square_roots_.size(); ++i)
    row[i] -= static_cast<float>(mean) * weight_square_roots_[i];
}

/// Computes the coordinate functions, in the order of FunctionRowOrder. Each of the following has
/// three rows (x, y, z): the mean head, each head's deviation from the mean head, and each
/// displacement field. A displacement field is the part of a mode that belongs to one head,
/// multiplied by the weights of one region.
///
/// \param max_coefficients  #modes: the largest absolute coefficient of each mode over all levels.
///                          Modes have unit length, so each mode's rows are multiplied by this
///                          coefficient.
FloatRows FaceSpace::coordinate_functions(const SpanBasis& modes,
                                          const std::vector<float>& max_coefficients,
                                          const FunctionRowOrder& rows) const {
  const Index size = weight_square_roots_.size(), regions = heads_.region_weights.cols();
  FloatRows functions(rows.count(regions), size);
  for (Index c = 0; c < 3; ++c) {
    write_centred_values([&](Index i) { return heads_.mean(sample_at(i), c); },
                         functions.row(c).data());
    for (Index h = 0; h < rows.heads; ++h) {
      const Positions& head = sampled_heads_containing(h).heads[unmirrored_index(h)];
      write_centred_values(
          [&](Index i) { return head(sample_at(i), c) - heads_.mean(sample_at(i), c); },
          functions.row(rows.of_head(h) + c).data());
    }
  }
  parallel_for_each(regions * rows.heads, [&](Index kh) {
    const Index k = kh / rows.heads, h = kh % rows.heads;
    const Columns& alpha = sampled_heads_containing(h).region_weights;
    for (Index r = 0; r < rows.modes; ++r) {
      float* const first = functions.row(rows.of_field(kh, r)).data();
      for (Index c = 0; c < 3; ++c) {
        const float* mode = modes.directions.row(r).data() + (h * 3 + c) * size;
        write_centred_values(
            [&](Index i) {  // divide by √w, because the values of a mode already contain √w
              return alpha(sample_at(i), k) * static_cast<double>(mode[i]) /
                     static_cast<double>(weight_square_roots_[i]);
            },
            first + c * size);
      }
      for (Index i = 0; i < 3 * size; ++i)
        first[i] *= max_coefficients[static_cast<std::size_t>(r)];
    }
  });
  return functions;
}

/// Finds P orthonormal scalar functions on the samples such that each coordinate (x, y, z) of each
/// face is a linear combination of these functions. A #P by 3 matrix of coefficients then
/// represents a face. The distance between two such matrices is the distance between the samples of
/// the two faces, and rotating a matrix rotates the face.
///
/// Every face is a linear combination of the heads and of displacement fields. A displacement field
/// is the displacement of one head by smoothing, multiplied by the weights of one region. The basis
/// functions span the coordinates of all heads and all displacement fields.
///
/// \return  The functions, #P by #S.
FloatRows FaceSpace::compute_basis_functions() {
  const SpanBasis modes = smoothing_displacement_modes();
  tables_.level_coefficients = modes.coordinates;
  std::vector<float> max_coefficients;
  for (Index r = 0; r < modes.directions.rows(); ++r) {
    max_coefficients.push_back(modes.coordinates.col(r).cwiseAbs().maxCoeff());
    for (Index l = 0; l < tables_.level_coefficients.rows(); ++l)
      tables_.level_coefficients(l, r) /= max_coefficients.back();
  }
  const FunctionRowOrder rows{head_point_count(), modes.directions.rows()};
  SpanBasis basis = span_basis(coordinate_functions(modes, max_coefficients, rows), kFieldTolerance,
                               mirror_variant_count() * kMaxBasisFunctions);
  tables_.basis_coefficients = std::move(basis.coordinates);
  return std::move(basis.directions);
}

void FaceSpace::compute_head_shapes_and_fields() {
  const FunctionRowOrder rows{head_point_count(), tables_.level_coefficients.cols()};
  const auto shape_at = [&](Index row) -> Shape {
    return tables_.basis_coefficients.middleRows<3>(row).transpose();
  };
  mean_shape_ = shape_at(0);
  for (Index h = 0; h < rows.heads; ++h) {
    head_shapes_.push_back(mean_shape_ + shape_at(rows.of_head(h)));
  }
  const auto levels = static_cast<Index>(heads_.levels.size());
  const Index fields = heads_.region_weights.cols() * rows.heads, size = mean_shape_.size();
  displacement_fields_.assign(static_cast<std::size_t>(fields * levels * size), 0.F);
  parallel_for_each(fields, [&](Index kh) {
    for (Index r = 0; r < rows.modes; ++r) {
      const Shape mode = shape_at(rows.of_field(kh, r));
      for (Index l = 0; l < levels; ++l) {
        const float factor = tables_.level_coefficients(l, r);
        float* out = displacement_fields_.data() + (kh * levels + l) * size;
        for (Index i = 0; i < size; ++i) out[i] += factor * mode.data()[i];
      }
    }
  });
}

const float* FaceSpace::displacement_field(std::size_t region, Index head, Index row) const {
  const auto rows = static_cast<Index>(heads_.levels.size());
  const Index at = (static_cast<Index>(region) * head_point_count() + head) * rows + row;
  return displacement_fields_.data() + at * mean_shape_.size();
}

/// Returns the shape of a recipe's face with the recipe's extrapolation factors. If any factor is
/// not 1, also returns the face's shape with all factors 1.
std::vector<FaceSpace::Shape> FaceSpace::shapes_of(const Recipe& recipe) const {
  const double w = mirror_image_weight(recipe);
  require(w == 0 || mirror_variant_count() == 2, "a mirrored face, and no mirror images of heads");
  std::vector<Shape> shapes = shapes_of_mirror_variant(recipe, w == 1 ? 1 : 0);
  if (w == 0 || w == 1) return shapes;
  const std::vector<Shape> mirrored = shapes_of_mirror_variant(recipe, 1);
  for (std::size_t i = 0; i < shapes.size(); ++i)
    shapes[i] = static_cast<float>(1 - w) * shapes[i] + static_cast<float>(w) * mirrored[i];
  return shapes;
}

/// Returns the shapes of a recipe's face: of the unmirrored face (orientation 0) or of its mirror
/// image (orientation 1).
std::vector<FaceSpace::Shape> FaceSpace::shapes_of_mirror_variant(const Recipe& recipe,
                                                                  Index orientation) const {
  const Index first = orientation * head_count();
  std::vector<Shape> shapes(is_extrapolated(recipe) ? 2 : 1,
                            target_matrix<Shape>(recipe, [&](Index head) -> const Shape& {
                              return head_shapes_[static_cast<std::size_t>(first + head)];
                            }));
  const auto size = static_cast<std::size_t>(mean_shape_.size());
  for (std::size_t k = 0; k < recipe.regions.size(); ++k) {
    const std::vector<LevelWeights> as_given = weights_by_level(recipe, k),
                                    none = weights_by_level(recipe, k, Extrapolation::kNone);
    for (std::size_t l = 0; l < as_given.size(); ++l) {
      for (const WeightedTrajectoryRow& level :
           interpolation_rows(heads_.levels, as_given[l].level)) {
        for (std::size_t i = 0; i < as_given[l].weights.size(); ++i) {
          const float* from = displacement_field(k, first + as_given[l].weights[i].head, level.row);
          const auto add_to = [&](Shape& shape, double weight) {
            add_scaled(static_cast<float>(weight * level.weight), from, size, shape.data());
          };
          add_to(shapes.front(), as_given[l].weights[i].weight);
          if (shapes.size() > 1) add_to(shapes.back(), none[l].weights[i].weight);
        }
      }
    }
  }
  return shapes;
}

/// Rotates a shape to the best fit with the mean head, and subtracts the mean head.
std::vector<float> FaceSpace::aligned_deviation(const Shape& shape) const {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (Index p = 0; p < shape.rows(); ++p) {
    for (Index a = 0; a < 3; ++a) {
      for (Index b = 0; b < 3; ++b) {
        covariance(a, b) +=
            static_cast<double>(mean_shape_(p, a)) * static_cast<double>(shape(p, b));
      }
    }
  }
  const Eigen::Matrix3d rotation = best_rotation(covariance);
  std::vector<float> turned(static_cast<std::size_t>(shape.size()));
  for (Index p = 0; p < shape.rows(); ++p) {
    for (Index a = 0; a < 3; ++a) {
      double sum = 0;
      for (Index b = 0; b < 3; ++b) sum += rotation(a, b) * static_cast<double>(shape(p, b));
      turned[static_cast<std::size_t>(3 * p + a)] =
          static_cast<float>(sum - static_cast<double>(mean_shape_(p, a)));
    }
  }
  return turned;
}

void FaceSpace::find_principal_directions(std::size_t bands) {
  const Index heads = head_point_count();
  FloatRows rows(heads + static_cast<Index>(kTrainingFaces), mean_shape_.size());
  parallel_for_each(rows.rows(), [&](Index n) {
    const std::vector<float> at =
        n < heads
            ? aligned_deviation(head_shapes_[static_cast<std::size_t>(n)])
            : aligned_deviation(shapes_of(random_training_recipe(
                                              heads_, bands, static_cast<std::uint64_t>(n - heads)))
                                    .front());
    std::copy(at.begin(), at.end(), rows.row(n).data());
  });
  tables_.principal_directions =
      span_basis(std::move(rows), kFaceTolerance, mirror_variant_count() * kMaxDirections)
          .directions;
}

/// Transposes the principal directions, and pads them with zeros to whole SIMD vectors.
void FaceSpace::transpose_directions() {
  constexpr Index kLanes = 16;
  const Index rank = tables_.principal_directions.rows();
  directions_transposed_ =
      FloatRows::Zero(tables_.principal_directions.cols(), (rank + kLanes - 1) / kLanes * kLanes);
  directions_transposed_.leftCols(rank) = tables_.principal_directions.transpose();
}

std::vector<Eigen::VectorXf> FaceSpace::coordinates(const std::vector<Shape>& shapes) const {
  std::vector<float> deviations;
  for (const Shape& shape : shapes) {
    const std::vector<float> deviation = aligned_deviation(shape);
    deviations.insert(deviations.end(), deviation.begin(), deviation.end());
  }
  const auto count = static_cast<Index>(shapes.size()), rank = tables_.principal_directions.rows();
  const auto length = static_cast<std::size_t>(directions_transposed_.rows());
  FloatRows products = FloatRows::Zero(count, directions_transposed_.cols());
  add_product(deviations.data(), shapes.size(), length, directions_transposed_.data(),
              static_cast<std::size_t>(products.cols()), products.data());
  std::vector<Eigen::VectorXf> results;
  for (Index n = 0; n < count; ++n) {
    const float* at = deviations.data() + static_cast<std::size_t>(n) * length;
    Eigen::VectorXf& result = results.emplace_back(rank + 1);
    result.head(rank) = products.row(n).head(rank);
    // The last coordinate is the distance of the face from the span of the directions. Each face
    // consists of a component in the span and a component outside. For two faces, the difference of
    // their last coordinates is at most the distance between the components outside.
    const double rest =
        fixed_order_dot(at, at, length) -
        fixed_order_dot(result.data(), result.data(), static_cast<std::size_t>(rank));
    result[rank] = static_cast<float>(std::sqrt(std::max(rest, 0.0)));
  }
  return results;
}

std::vector<FaceSpace::Point> FaceSpace::points(std::span<const Recipe* const> recipes) const {
  std::vector<Shape> all;
  for (const Recipe* recipe : recipes) {
    for (Shape& shape : shapes_of(*recipe)) all.push_back(std::move(shape));
  }
  std::vector<Eigen::VectorXf> found = coordinates(all);
  std::vector<Point> points;
  auto next = found.begin();
  for (const Recipe* recipe : recipes) {
    Point& point = points.emplace_back();
    point.coordinates_with_extrapolation = std::move(*next++);
    point.coordinates_without_extrapolation =
        is_extrapolated(*recipe) ? std::move(*next++) : point.coordinates_with_extrapolation;
  }
  return points;
}

FaceSpace::Point FaceSpace::point(const Recipe& recipe) const {
  const Recipe* const only = &recipe;
  return std::move(points({&only, 1}).front());
}

FaceSpace::Point FaceSpace::head_point(Index head) const {
  const Eigen::VectorXf at = coordinates({head_shapes_[static_cast<std::size_t>(head)]}).front();
  return {at, at};
}

double FaceSpace::distance(const Point& a, const Point& b) {
  return std::sqrt(std::min(
      squared_distance(a.coordinates_with_extrapolation, b.coordinates_with_extrapolation),
      squared_distance(a.coordinates_without_extrapolation, b.coordinates_without_extrapolation)));
}

void FaceSpace::compute_region_area_fractions() {
  for (Index k = 0; k < heads_.region_weights.cols(); ++k) {
    double share = 0;
    for (Index i = 0; i < weight_square_roots_.size(); ++i) {
      share += static_cast<double>(weight_square_roots_[i]) *
               static_cast<double>(weight_square_roots_[i]) *
               heads_.region_weights(sample_at(i), k);
    }
    region_area_fractions_.push_back(share);
  }
}

/// Finds the metric M_k of each region k. For two points x and y of faces in the span of the
/// principal directions, (x − y)ᵀ M_k (x − y) = Σ_s w_s α_k(s) d(s)², where w_s is the weight of
/// sample s, α_k(s) is the weight of region k at sample s, and d(s) is the distance between the two
/// faces at sample s. M_k = V G_k Vᵀ, where the rows of V are the principal directions, G_k = U
/// diag(α_k) Uᵀ, and U holds the values of the basis functions at the samples, times √w_s.
void FaceSpace::find_region_metrics(const FloatRows& basis) {
  const FloatRows& directions = tables_.principal_directions;
  const Index functions = basis.rows(), rank = directions.rows();
  for (Index k = 0; k < heads_.region_weights.cols(); ++k) {
    FloatRows masked = basis;  // the values of the basis contain √w_s
    for (Index i = 0; i < basis.cols(); ++i) {
      const double alpha = heads_.region_weights(sample_at(i), k);
      const auto root = static_cast<float>(std::sqrt(std::max(alpha, 0.0)));
      for (Index p = 0; p < functions; ++p) masked(p, i) *= root;
    }
    const auto samples = static_cast<std::size_t>(masked.cols());
    FloatRows gram(functions, functions);
    parallel_for_each(functions, [&](Index p) {
      for (Index q = 0; q <= p; ++q) {
        gram(p, q) = gram(q, p) = static_cast<float>(
            fixed_order_dot(masked.row(p).data(), masked.row(q).data(), samples));
      }
    });
    FloatRows metric(rank, rank);
    parallel_for_each(rank, [&](Index d) {
      // Multiply direction d by G_k, separately for each coordinate x, y, z. `add_product` reads
      // the rows of `gram` as columns, because G_k is symmetric.
      std::vector<float> along(static_cast<std::size_t>(3 * functions));
      for (Index c = 0; c < 3; ++c) {
        Eigen::VectorXf of_direction(functions), sums = Eigen::VectorXf::Zero(functions);
        for (Index q = 0; q < functions; ++q) of_direction[q] = directions(d, 3 * q + c);
        add_product(of_direction.data(), 1, static_cast<std::size_t>(functions), gram.data(),
                    static_cast<std::size_t>(functions), sums.data());
        for (Index p = 0; p < functions; ++p) along[static_cast<std::size_t>(3 * p + c)] = sums[p];
      }
      for (Index e = 0; e < rank; ++e) {
        metric(e, d) = static_cast<float>(
            fixed_order_dot(directions.row(e).data(), along.data(), along.size()));
      }
    });
    tables_.region_metrics.push_back(std::move(metric));
  }
}

FaceSpace::RegionPoint FaceSpace::region_point(const Point& point, Index region) const {
  RegionPoint result{&point, {}, {}};
  if (tables_.region_metrics.empty()) return result;
  const FloatRows& metric = tables_.region_metrics[static_cast<std::size_t>(region)];
  const auto times = [&](const Eigen::VectorXf& at) {
    const auto size = static_cast<std::size_t>(metric.rows());
    Eigen::VectorXf product(metric.rows());
    for (Index i = 0; i < metric.rows(); ++i) {
      product[i] = static_cast<float>(fixed_order_dot(metric.row(i).data(), at.data(), size));
    }
    return product;
  };
  result.metric_times_coordinates_with_extrapolation = times(point.coordinates_with_extrapolation);
  result.metric_times_coordinates_without_extrapolation =
      times(point.coordinates_without_extrapolation);
  return result;
}

double FaceSpace::region_distance(const RegionPoint& a, const RegionPoint& b, Index region) const {
  if (tables_.region_metrics.empty()) return distance(*a.point, *b.point);
  const double share = region_area_fractions_[static_cast<std::size_t>(region)];
  if (!(share > 0)) return 0;
  // Computes (x − y)ᵀ M (x − y) from M x and M y.
  const auto squared = [](const Eigen::VectorXf& x, const Eigen::VectorXf& y,
                          const Eigen::VectorXf& metric_x, const Eigen::VectorXf& metric_y) {
    double sum = 0;
    for (Index i = 0; i < metric_x.size(); ++i) {
      sum += (static_cast<double>(x[i]) - static_cast<double>(y[i])) *
             (static_cast<double>(metric_x[i]) - static_cast<double>(metric_y[i]));
    }
    return std::max(sum, 0.0);
  };
  const double squared_with_extrapolation = squared(
      a.point->coordinates_with_extrapolation, b.point->coordinates_with_extrapolation,
      a.metric_times_coordinates_with_extrapolation, b.metric_times_coordinates_with_extrapolation);
  const double squared_without_extrapolation = squared(
      a.point->coordinates_without_extrapolation, b.point->coordinates_without_extrapolation,
      a.metric_times_coordinates_without_extrapolation,
      b.metric_times_coordinates_without_extrapolation);
  return std::sqrt(std::min(squared_with_extrapolation, squared_without_extrapolation) / share);
}

Eigen::MatrixXd FaceSpace::head_distances() const {
  const Index count = head_count();
  std::vector<Point> points;
  for (Index h = 0; h < count; ++h) points.push_back(head_point(h));
  Eigen::MatrixXd distances(count, count);
  for (Index a = 0; a < count; ++a) {
    for (Index b = 0; b < count; ++b) {
      distances(a, b) =
          distance(points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)]);
    }
  }
  return distances;
}

}  // namespace crowdface
