// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/shape_regression.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

/// Standard deviations of the pose's rotation (radians), translation and scale.
constexpr double kTurn = 0.05, kShiftMm = 5, kPoseGrowth = 0.02;
constexpr Index kPose = 7;

/// One measurement for the regression: how far a skin vertex is displaced along a direction. The
/// measurement comes from the scan or from a landmark.
struct Observation {
  std::uint32_t vertex = kNoIndex;
  Eigen::Vector3d direction;
  double value, variance;
};

/// Selects visible vertices by farthest-point sampling.
std::vector<std::uint32_t> sample_visible_vertices(const SkinMesh& skin, const Positions& positions,
                                                   std::size_t most) {
  std::vector<std::uint32_t> visible, places;
  for (std::uint32_t v = 0; v < skin.ambient_visibility.size(); ++v) {
    if (skin.ambient_visibility[v] > kUnfoldedSkinThreshold) visible.push_back(v);
  }
  most = std::min(most, visible.size());
  std::vector<double> squared(visible.size(), 1e300);
  for (std::size_t next = 0; places.size() < most;) {
    places.push_back(visible[next]);
    const Eigen::RowVector3d last = positions.row(places.back());
    next = 0;
    for (std::size_t i = 0; i < visible.size(); ++i) {
      squared[i] = std::min(squared[i], (positions.row(visible[i]) - last).squaredNorm());
      if (squared[i] > squared[next]) next = i;
    }
  }
  return places;
}

class Regression {
 public:
  Regression(const ShapeModel& model, const RegressionOptions& options)
      : model_(model), options_(options), middle_(model.mean.colwise().mean().transpose()) {}

  /// Returns the most likely displacement of each skin vertex from the model's mean, #skin by 3,
  /// given the observations (Gaussian process regression).
  Positions displacements(const std::vector<Observation>& observations) const {
    const auto count = static_cast<Index>(observations.size()),
               modes = static_cast<Index>(model_.modes.size());
    Eigen::MatrixXd along(modes, count), pose(kPose, count), directions(3, count), places(3, count);
    Eigen::VectorXd values(count), variances(count);
    for (Index i = 0; i < count; ++i) {
      const Observation& one = observations[static_cast<std::size_t>(i)];
      for (Index k = 0; k < modes; ++k) {
        along(k, i) =
            row3(model_.modes[static_cast<std::size_t>(k)], one.vertex).dot(one.direction);
      }
      pose.col(i) = pose_modes(one.vertex) * one.direction;
      directions.col(i) = one.direction;
      places.col(i) = row3(model_.mean, one.vertex);
      values(i) = one.value;
      variances(i) = one.variance;
    }
    const double local = options_.local_variance_fraction,
                 smooth = options_.smooth_deformation_deviation_mm *
                          options_.smooth_deformation_deviation_mm;
    const Eigen::MatrixXd heads = along.transpose() * along;
    Eigen::MatrixXd covariance = (1 - local) * heads + pose.transpose() * pose;
    for (Index i = 0; i < count; ++i) {
      covariance.col(i).array() +=
          nearness(places, places.col(i)).array() *
          (local * heads.col(i) + smooth * directions.transpose() * directions.col(i)).array();
    }
    covariance.diagonal() += variances;
    const Eigen::VectorXd weights = covariance.llt().solve(values);

    const Eigen::VectorXd of_heads = (1 - local) * along * weights, of_pose = pose * weights;
    Eigen::MatrixXd local_weights(modes + 3, count);
    local_weights << local * along * weights.asDiagonal(),
        smooth * directions * weights.asDiagonal();
    Positions result(model_.mean.rows(), 3);
    parallel_blocks(result.rows(), 64, [&](Index begin, Index end) {
      Eigen::MatrixXd near(count, end - begin);
      for (Index v = begin; v < end; ++v)
        near.col(v - begin) = nearness(places, row3(model_.mean, v));
      const Eigen::MatrixXd there = local_weights * near;
      for (Index v = begin; v < end; ++v) {
        Eigen::Vector3d sum = pose_modes(v).transpose() * of_pose + there.col(v - begin).tail<3>();
        for (Index k = 0; k < modes; ++k) {
          sum += (of_heads(k) + there(k, v - begin)) *
                 row3(model_.modes[static_cast<std::size_t>(k)], v);
        }
        result.row(v) = sum.transpose();
      }
    });
    return result;
  }

 private:
  /// Derivatives of a vertex's position with respect to translation, rotation and scale of the
  /// head, each multiplied by the standard deviation of that parameter.
  Eigen::Matrix<double, kPose, 3> pose_modes(Index vertex) const {
    const Eigen::Vector3d arm = row3(model_.mean, vertex) - middle_;
    Eigen::Matrix<double, kPose, 3> modes;
    modes.topRows<3>() = kShiftMm * Eigen::Matrix3d::Identity();
    for (Index k = 0; k < 3; ++k) {
      modes.row(3 + k) = kTurn * Eigen::Vector3d::Unit(k).cross(arm).transpose();
    }
    modes.row(6) = kPoseGrowth * arm.transpose();
    return modes;
  }

  Eigen::VectorXd nearness(const Eigen::MatrixXd& places, const Eigen::Vector3d& place) const {
    return ((places.colwise() - place).colwise().squaredNorm() /
            (-2 * options_.correlation_length_mm * options_.correlation_length_mm))
        .array()
        .exp()
        .transpose();
  }

  const ShapeModel& model_;
  const RegressionOptions& options_;
  Eigen::Vector3d middle_;
};

/// Measures displacements from sampled skin vertices to the scan.
std::vector<Observation> observe_scan(const SkinMesh& skin, const ShapeModel& model,
                                      const Positions& positions, const ScanSurface& scan,
                                      const std::vector<std::uint32_t>& places, double reach,
                                      double noise_deviation_mm) {
  const Positions normals = vertex_normals_or_zero(skin.triangles, positions);
  std::vector<Observation> observations(places.size());
  parallel_for_each(places.size(), 64, [&](std::size_t i) {
    const std::uint32_t v = places[i];
    const auto place = scan.nearest(row3(positions, v), row3(normals, v), kMinNormalCosine, reach);
    if (!place.is_found) return;
    const double off = place.normal.dot(place.point - row3(positions, v));
    observations[i] = {v, place.normal, place.normal.dot(place.point - row3(model.mean, v)), off};
  });
  std::erase_if(observations, [](const Observation& one) { return one.vertex == kNoIndex; });
  std::vector<double> distances;
  for (const Observation& one : observations) distances.push_back(std::abs(one.variance));
  const double spread = outlier_distance(std::move(distances), reach);
  for (Observation& one : observations) {  // outliers get a large variance
    const double share = 1 + one.variance * one.variance / (spread * spread);
    one.variance = noise_deviation_mm * noise_deviation_mm * share * share;
  }
  return observations;
}

}  // namespace

Positions regress_shape(const SkinMesh& skin, const ShapeModel& model, const Positions& positions,
                        const ScanSurface& scan, const std::vector<WrapLandmark>& landmarks,
                        const RegressionOptions& options) {
  const Regression regression(model, options);
  const std::vector<std::uint32_t> places =
      sample_visible_vertices(skin, model.mean, options.sample_count);
  Positions current = positions;
  for (const double reach : options.search_radii_mm) {
    throw_if_interrupted();
    std::vector<Observation> observations =
        observe_scan(skin, model, current, scan, places, reach, options.noise_deviation_mm);
    for (const WrapLandmark& landmark : landmarks) {
      for (Index k = 0; k < 3; ++k) {
        observations.push_back({landmark.vertex, Eigen::Vector3d::Unit(k),
                                landmark.scan_position(k) - model.mean(landmark.vertex, k),
                                landmark.error_mm * landmark.error_mm});
      }
    }
    current = model.mean + regression.displacements(observations);
  }
  return current;
}

}  // namespace crowdface
