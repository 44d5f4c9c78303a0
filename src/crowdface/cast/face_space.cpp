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

/// Tolerance for two approximations by span_basis: of the displacements of the heads by smoothing,
/// and of the coordinate functions (see FaceSpaceTables). Each error is at most kFieldTolerance
/// millimetres, as root mean square over the face.
constexpr double kFieldTolerance = 0.02;
/// Largest number P of orthonormal basis functions for each orientation (unmirrored and mirrored).
constexpr Index kMaxBasisFunctions = 400;
/// FaceSpace leaves out principal directions as long as this moves no training face by more than
/// this distance, in millimetres. An additional coordinate stores the distance of a face from the
/// span of the remaining directions.
constexpr double kFaceTolerance = 0.05;
/// Largest number of principal directions for each orientation (unmirrored and mirrored), before
/// FaceSpace leaves out directions.
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

/// The order of the coordinate functions: the mean head, then the deviation of each head from the
/// mean head, then the displacement fields. The fields are sorted by region, then by head, then by
/// mode (see smoothing_displacement_modes). Each function has three rows in a matrix: x, y and z.
struct FaceSpace::FunctionOrder {
  Index heads, modes;
  static constexpr Index kMean = 0;
  static Index of_head(Index head) { return 1 + head; }
  Index of_field(Index region_and_head, Index mode) const {
    return 1 + heads + region_and_head * modes + mode;
  }
  Index count(Index regions) const { return of_field(regions * heads, 0); }
};

FaceSpace::FaceSpace(HeadsAtSamples heads, const std::vector<double>& weights, std::size_t bands)
    : heads_(std::move(heads)) {
  choose_nonzero_weight_samples(weights);
  const FloatRows basis = compute_basis_functions();
  mean_shape_ = tables_.basis_coefficients.topRows<3>();
  find_principal_directions(bands);
  transpose_directions();
  if (heads_.region_weights.cols() == 1) return;
  compute_region_area_fractions();
  find_region_metrics(basis);
}

FaceSpace::FaceSpace(HeadsAtSamples heads, const std::vector<double>& weights,
                     FaceSpaceTables tables)
    : heads_(std::move(heads)), tables_(std::move(tables)) {
  require(have_matching_sizes(tables_, heads_), "face space: tables of other heads");
  choose_nonzero_weight_samples(weights);
  mean_shape_ = tables_.basis_coefficients.topRows<3>();
  transpose_directions();
  if (heads_.region_weights.cols() > 1) compute_region_area_fractions();
}

bool FaceSpace::have_matching_sizes(const FaceSpaceTables& tables, const HeadsAtSamples& heads) {
  const std::size_t mirror_variant_count = heads.mirror_images == nullptr ? 1 : 2;
  const FunctionOrder order{static_cast<Index>(mirror_variant_count * heads.heads.size()),
                            tables.level_coefficients.cols()};
  const Index regions = heads.region_weights.cols(), rank = tables.principal_directions.rows();
  return tables.level_coefficients.rows() == static_cast<Index>(heads.levels.size()) &&
         tables.basis_coefficients.rows() == 3 * order.count(regions) &&
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

SpanBasis FaceSpace::smoothing_displacement_modes() const {
  const Index heads = head_point_count(), size = weight_square_roots_.size();
  const auto level_count = static_cast<Index>(heads_.levels.size());
  FloatRows levels(level_count, heads * 3 * size);
  parallel_for_each(heads, [&](Index h) {
    const Trajectory& trajectory = heads_at_samples_containing(h).trajectories[unmirrored_index(h)];
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

/// Computes the coordinate functions, in the order of FunctionOrder. Each mode has one displacement
/// per head and sample (see smoothing_displacement_modes). The displacement field of a region, a
/// head and a mode has the mode's displacements for this head, multiplied by the region's weights.
///
/// \param max_coefficients  #modes: the largest absolute coefficient of each mode over all levels.
///                          All displacement fields of a mode are multiplied by this coefficient,
///                          because the modes themselves have unit length.
FloatRows FaceSpace::coordinate_functions(const SpanBasis& modes,
                                          const std::vector<float>& max_coefficients,
                                          const FunctionOrder& order) const {
  const Index size = weight_square_roots_.size(), regions = heads_.region_weights.cols();
  FloatRows functions(3 * order.count(regions), size);
  for (Index c = 0; c < 3; ++c) {
    write_centred_values([&](Index i) { return heads_.mean(sample_at(i), c); },
                         functions.row(3 * FunctionOrder::kMean + c).data());
    for (Index h = 0; h < order.heads; ++h) {
      const Positions& head = heads_at_samples_containing(h).heads[unmirrored_index(h)];
      write_centred_values(
          [&](Index i) { return head(sample_at(i), c) - heads_.mean(sample_at(i), c); },
          functions.row(3 * order.of_head(h) + c).data());
    }
  }
  parallel_for_each(regions * order.heads, [&](Index kh) {
    const Index k = kh / order.heads, h = kh % order.heads;
    const Columns& alpha = heads_at_samples_containing(h).region_weights;
    for (Index r = 0; r < order.modes; ++r) {
      float* const first = functions.row(3 * order.of_field(kh, r)).data();
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

FloatRows FaceSpace::compute_basis_functions() {
  const SpanBasis modes = smoothing_displacement_modes();
  tables_.level_coefficients = modes.coordinates;
  std::vector<float> max_coefficients;
  for (Index r = 0; r < modes.directions.rows(); ++r) {
    max_coefficients.push_back(modes.coordinates.col(r).cwiseAbs().maxCoeff());
    for (Index l = 0; l < tables_.level_coefficients.rows(); ++l)
      tables_.level_coefficients(l, r) /= max_coefficients.back();
  }
  const FunctionOrder order{head_point_count(), modes.directions.rows()};
  SpanBasis basis = span_basis(coordinate_functions(modes, max_coefficients, order),
                               kFieldTolerance, mirror_variant_count() * kMaxBasisFunctions);
  tables_.basis_coefficients = std::move(basis.coordinates);
  return std::move(basis.directions);
}

void FaceSpace::add_coefficients(const Recipe& recipe, Extrapolation extrapolation,
                                 Index orientation, double factor, float* to) const {
  const FunctionOrder order{head_point_count(), tables_.level_coefficients.cols()};
  const Index first = orientation * head_count();
  const auto add_head = [&](Index head, double weight) {
    to[order.of_head(first + head)] += static_cast<float>(factor * weight);
  };
  to[FunctionOrder::kMean] += static_cast<float>(factor);
  if (recipe.mixture.empty()) add_head(recipe.target, 1);
  for (const SourceWeight& part : recipe.mixture) add_head(part.head, part.weight);
  for (std::size_t k = 0; k < recipe.regions.size(); ++k) {
    for (const LevelWeights& level : weights_by_level(recipe, k, extrapolation)) {
      Eigen::RowVectorXf modes = Eigen::RowVectorXf::Zero(order.modes);
      for (const WeightedTrajectoryRow& row : interpolation_rows(heads_.levels, level.level))
        modes += static_cast<float>(row.weight) * tables_.level_coefficients.row(row.row);
      for (const SourceWeight& part : level.weights) {
        const Index head = static_cast<Index>(k) * order.heads + first + part.head;
        add_scaled(static_cast<float>(factor * part.weight), modes.data(),
                   static_cast<std::size_t>(order.modes), to + order.of_field(head, 0));
      }
    }
  }
}

std::vector<float> FaceSpace::coefficients(const Recipe& recipe,
                                           Extrapolation extrapolation) const {
  const double w = mirror_image_weight(recipe);
  require(w == 0 || mirror_variant_count() == 2, "a mirrored face, and no mirror images of heads");
  std::vector<float> sum(function_count(), 0.F);
  if (w != 1) add_coefficients(recipe, extrapolation, 0, 1 - w, sum.data());
  if (w != 0) add_coefficients(recipe, extrapolation, 1, w, sum.data());
  return sum;
}

std::vector<float> FaceSpace::head_coefficients(Index head) const {
  std::vector<float> sum(function_count(), 0.F);
  sum[static_cast<std::size_t>(FunctionOrder::kMean)] = 1;
  sum[static_cast<std::size_t>(FunctionOrder::of_head(head))] = 1;
  return sum;
}

FloatRows FaceSpace::aligned_deviations(const std::vector<float>& coefficients) const {
  const auto functions = function_count();
  const std::size_t faces = coefficients.size() / functions;
  FloatRows shapes = FloatRows::Zero(static_cast<Index>(faces), mean_shape_.size());
  add_product(coefficients.data(), faces, functions, tables_.basis_coefficients.data(),
              static_cast<std::size_t>(mean_shape_.size()), shapes.data());
  for (Index n = 0; n < shapes.rows(); ++n)
    align_and_subtract_mean(Eigen::Map<Shape>(shapes.row(n).data(), 3, mean_shape_.cols()));
  return shapes;
}

void FaceSpace::align_and_subtract_mean(Eigen::Map<Shape> shape) const {
  const auto size = static_cast<std::size_t>(shape.cols());
  Eigen::Matrix3d covariance;
  for (Index a = 0; a < 3; ++a) {
    for (Index b = 0; b < 3; ++b)
      covariance(a, b) = fixed_order_dot(mean_shape_.row(a).data(), shape.row(b).data(), size);
  }
  const Eigen::Matrix3d rotation = best_rotation(covariance);
  for (Index p = 0; p < shape.cols(); ++p) {
    const Eigen::Vector3d at = shape.col(p).cast<double>(),
                          mean = mean_shape_.col(p).cast<double>();
    for (Index a = 0; a < 3; ++a) {
      const double turned =
          rotation(a, 0) * at(0) + rotation(a, 1) * at(1) + rotation(a, 2) * at(2);
      shape(a, p) = static_cast<float>(turned - mean(a));
    }
  }
}

void FaceSpace::find_principal_directions(std::size_t bands) {
  const Index heads = head_point_count();
  FloatRows rows(heads + static_cast<Index>(kTrainingFaces), mean_shape_.size());
  parallel_for_each(rows.rows(), [&](Index n) {
    rows.row(n) =
        aligned_deviations(n < heads ? head_coefficients(n)
                                     : coefficients(random_training_recipe(
                                           heads_, bands, static_cast<std::uint64_t>(n - heads))));
  });
  const SpanBasis span =
      span_basis(std::move(rows), kFaceTolerance / 2, mirror_variant_count() * kMaxDirections);
  tables_.principal_directions = principal_basis(span, kFaceTolerance).directions;
}

void FaceSpace::transpose_directions() {
  constexpr Index kLanes = 16;
  const Index rank = tables_.principal_directions.rows();
  directions_transposed_ =
      FloatRows::Zero(tables_.principal_directions.cols(), (rank + kLanes - 1) / kLanes * kLanes);
  directions_transposed_.leftCols(rank) = tables_.principal_directions.transpose();
}

std::vector<Eigen::VectorXf> FaceSpace::coordinates(const std::vector<float>& coefficients) const {
  const FloatRows deviations = aligned_deviations(coefficients);
  const Index count = deviations.rows(), rank = tables_.principal_directions.rows();
  const auto length = static_cast<std::size_t>(deviations.cols());
  const FloatRows products = fixed_order_product(deviations, directions_transposed_);
  std::vector<Eigen::VectorXf> results;
  for (Index n = 0; n < count; ++n) {
    const float* at = deviations.row(n).data();
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
  std::vector<float> all;
  const auto append = [&](const std::vector<float>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  for (const Recipe* recipe : recipes) {
    append(coefficients(*recipe));
    if (is_extrapolated(*recipe)) append(coefficients(*recipe, Extrapolation::kNone));
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
  const Eigen::VectorXf at = coordinates(head_coefficients(head)).front();
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
      // `gram` is the matrix G_k of region k (see find_region_metrics). Multiply principal
      // direction number d by G_k, separately for each coordinate x, y, z. `add_product` may read
      // the rows of `gram` as columns, because G_k is symmetric.
      const auto count = static_cast<std::size_t>(functions);
      std::vector<float> along(3 * count, 0.F);
      for (std::size_t c = 0; c < 3; ++c) {
        add_product(directions.row(d).data() + c * count, 1, count, gram.data(), count,
                    along.data() + c * count);
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
