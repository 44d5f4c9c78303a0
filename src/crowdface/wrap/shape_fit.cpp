// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/shape_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

/// Maximum number of vertices of the skin that the fit compares with the scan.
constexpr std::size_t kMaxProbes = 3000;
/// fraction of the correspondences that is used; the farthest are ignored
constexpr double kKeptFraction = 0.8;
constexpr Index kPoseUnknowns = 7;
/// Standard deviation of the pose's scale, relative to its first estimate, if a model is fitted.
constexpr double kScaleDeviation = 0.02;

/// A vertex and its closest point on the scan. Lengths are in the scan's unit.
struct Match {
  std::uint32_t vertex = kNoIndex;
  Eigen::Vector3d offset;  ///< vector from the vertex to the closest point
  Eigen::Vector3d normal;  ///< normal of the scan at the closest point
  double distance;
};

std::vector<std::uint32_t> choose_probes(const SkinMesh& skin) {
  std::vector<std::uint32_t> open;
  for (std::uint32_t v = 0; v < skin.vertices.size(); ++v) {
    if (skin.ambient_visibility[v] > kUnfoldedSkinThreshold) open.push_back(v);
  }
  return evenly_spaced_items(open, kMaxProbes);
}

std::vector<Match> find_matches(const Positions& placed, const Positions& normals,
                                const ScanSurface& scan, const std::vector<std::uint32_t>& probes,
                                double reach, std::vector<std::uint32_t>& found) {
  std::vector<Match> matches(probes.size());
  parallel_for_each(probes.size(), 128, [&](std::size_t i) {
    const std::uint32_t v = probes[i];
    const Eigen::Vector3d point = row3(placed, v);
    const auto place = scan.nearest(point, row3(normals, v), kMinNormalCosine, reach, found[i]);
    found[i] = place.triangle;
    if (place.is_found) matches[i] = {v, place.point - point, place.normal, place.distance};
  });
  std::erase_if(matches, [](const Match& match) { return match.vertex == kNoIndex; });
  return matches;
}

void leave_out_farthest(std::vector<Match>& matches) {
  std::vector<double> distances;
  for (const Match& match : matches) distances.push_back(match.distance);
  const auto rank =
      static_cast<std::size_t>(kKeptFraction * static_cast<double>(distances.size() - 1));
  const double most = nth_smallest(std::move(distances), rank);
  std::erase_if(matches, [&](const Match& match) { return match.distance > most; });
}

/// The normal equations of one step: rotation, translation, scale, then coefficients. The class
/// first collects the rows of the Jacobian, because one matrix product is faster than many updates.
class Equations {
 public:
  explicit Equations(Index modes)
      : matrix_(Eigen::MatrixXd::Zero(kPoseUnknowns + modes, kPoseUnknowns + modes)),
        right_(Eigen::VectorXd::Zero(kPoseUnknowns + modes)),
        rows_(kPoseUnknowns + modes, kMaxRows),
        values_(kMaxRows) {}

  /// Adds the term |weight · (jacobian · unknowns − value)|².
  /// \param jacobian  3 by #unknowns.
  void add(const Eigen::Matrix<double, 3, Eigen::Dynamic>& jacobian, const Eigen::Vector3d& value,
           const Eigen::Matrix3d& weight) {
    rows_.middleCols<3>(count_) = (weight * jacobian).transpose();
    values_.segment<3>(count_) = weight * value;
    count_ += 3;
    if (count_ == kMaxRows) add_collected_rows();
  }
  void hold(Index unknown, double value, double weight) {
    matrix_(unknown, unknown) += weight;
    right_(unknown) += weight * value;
  }
  Eigen::VectorXd solve() {
    add_collected_rows();
    return Eigen::LDLT<Eigen::MatrixXd, Eigen::Lower>(matrix_).solve(right_);
  }

 private:
  static constexpr Index kMaxRows = 384;

  void add_collected_rows() {
    if (count_ == 0) return;  // Eigen divides by the count
    matrix_.selfadjointView<Eigen::Lower>().rankUpdate(rows_.leftCols(count_));
    right_ += rows_.leftCols(count_) * values_.head(count_);
    count_ = 0;
  }

  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_;
  /// #unknowns by kMaxRows: each column is a row of the weighted Jacobian; `count_` columns are set
  Eigen::MatrixXd rows_;
  Eigen::VectorXd values_;
  Index count_ = 0;
};

/// Derivative of a point with respect to the unknowns, 3 by #unknowns; lengths in the scan's unit.
Eigen::Matrix<double, 3, Eigen::Dynamic> jacobian_of(const ShapeModel& model, const ShapeFit& fit,
                                                     std::uint32_t vertex,
                                                     const Eigen::Vector3d& arm) {
  Eigen::Matrix<double, 3, Eigen::Dynamic> jacobian(
      3, kPoseUnknowns + static_cast<Index>(model.modes.size()));
  jacobian.leftCols<3>() << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;
  jacobian.middleCols<3>(3).setIdentity();
  jacobian.col(6) = arm;
  const Eigen::Matrix3d motion = fit.pose.scale * fit.pose.rotation;
  for (std::size_t k = 0; k < model.modes.size(); ++k) {
    jacobian.col(kPoseUnknowns + static_cast<Index>(k)) =
        motion * model.modes[k].row(vertex).transpose();
  }
  return jacobian;
}

void apply(const Eigen::VectorXd& step, const Eigen::Vector3d& middle, ShapeFit& fit) {
  const Eigen::Vector3d turn = step.head<3>();
  const double angle = turn.norm();
  const Eigen::Matrix3d rotation = angle > 0
                                       ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix()
                                       : Eigen::Matrix3d::Identity();
  const double growth = std::clamp(1 + step(6), 0.8, 1.25);
  fit.pose.translation =
      growth * (rotation * (fit.pose.translation - middle)) + middle + step.segment<3>(3);
  fit.pose.rotation = best_rotation(rotation * fit.pose.rotation);
  fit.pose.scale *= growth;
  fit.coefficients += step.tail(fit.coefficients.size());
}

/// Improves `fit` by one Gauss–Newton step.
/// \return number of correspondences.
std::size_t step(const SkinMesh& skin, const ShapeModel& model, const ScanSurface& scan,
                 const std::vector<WrapLandmark>& landmarks,
                 const std::vector<std::uint32_t>& probes, double reach_mm,
                 const ShapeFitOptions& options, double first_scale,
                 std::vector<std::uint32_t>& found, ShapeFit& fit) {
  const Positions placed = fit.pose.apply(model.evaluate(fit.coefficients));
  std::vector<Match> matches = find_matches(placed, vertex_normals_or_zero(skin.triangles, placed),
                                            scan, probes, reach_mm * fit.pose.scale, found);
  if (matches.size() < probes.size() / 50 + 3) return 0;
  leave_out_farthest(matches);
  const double mm = fit.pose.scale;  // one millimetre in the scan's unit
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Match& match : matches) middle += placed.row(match.vertex).transpose();
  middle /= static_cast<double>(matches.size());
  const auto modes = static_cast<Index>(model.modes.size());
  Equations equations(modes);
  const double weight = options.scan_weight / (static_cast<double>(matches.size()) * mm * mm);
  for (const Match& match : matches) {
    const Eigen::Vector3d arm = placed.row(match.vertex).transpose() - middle;
    const double along = std::sqrt(options.tangential_weight);
    const Eigen::Matrix3d root =
        std::sqrt(weight) * (along * Eigen::Matrix3d::Identity() +
                             (1 - along) * match.normal * match.normal.transpose());
    equations.add(jacobian_of(model, fit, match.vertex, arm), match.offset, root);
  }
  const double for_landmarks = landmarks.empty()
                                   ? 0
                                   : options.landmark_weight * options.scan_weight /
                                         (static_cast<double>(landmarks.size()) * mm * mm);
  for (const WrapLandmark& landmark : landmarks) {
    const Eigen::Vector3d point = placed.row(landmark.vertex).transpose();
    equations.add(jacobian_of(model, fit, landmark.vertex, point - middle),
                  landmark.scan_position - point,
                  std::sqrt(for_landmarks * landmark.weight()) * Eigen::Matrix3d::Identity());
  }
  for (Index k = 0; k < modes; ++k) equations.hold(kPoseUnknowns + k, -fit.coefficients(k), 1);
  if (modes > 0) {  // the model, not the pose, explains differences in size
    equations.hold(6, 1 - fit.pose.scale / first_scale, 1 / (kScaleDeviation * kScaleDeviation));
  }
  // Pull all pose unknowns towards zero with a tiny weight. Otherwise the equations have no unique
  // solution if the surface does not determine an unknown, such as the rotation of a sphere.
  for (Index k = 0; k < kPoseUnknowns; ++k) equations.hold(k, 0, 1e-9);
  apply(equations.solve(), middle, fit);
  return matches.size();
}

}  // namespace

Similarity pose_of_landmarks(const Positions& positions,
                             const std::vector<WrapLandmark>& landmarks) {
  Positions from(static_cast<Index>(landmarks.size()), 3), to(from.rows(), 3);
  for (Index i = 0; i < from.rows(); ++i) {
    const WrapLandmark& landmark = landmarks[static_cast<std::size_t>(i)];
    from.row(i) = positions.row(landmark.vertex);
    to.row(i) = landmark.scan_position.transpose();
  }
  return fit_similarity(from, to, ScaleFit::kUniform);
}

Eigen::Vector3d apply_similarity(const Similarity& similarity, const Eigen::Vector3d& point) {
  return similarity.scale * (similarity.rotation * point) + similarity.translation;
}

ShapeFit fit_shape(const SkinMesh& skin, const ShapeModel& model, const ScanSurface& scan,
                   const std::vector<WrapLandmark>& landmarks, const ShapeFit& start,
                   const ShapeFitOptions& options) {
  const std::vector<std::uint32_t> probes = choose_probes(skin);
  std::vector<std::uint32_t> found(probes.size(), kNoIndex);
  ShapeFit fit = start;
  fit.coefficients.conservativeResizeLike(
      Eigen::VectorXd::Zero(static_cast<Index>(model.modes.size())));
  for (const double reach : options.search_radii_mm) {
    for (int i = 0; i < options.steps_per_round; ++i) {
      throw_if_interrupted();
      if (step(skin, model, scan, landmarks, probes, reach, options, start.pose.scale, found,
               fit) == 0)
        break;
    }
  }
  const Positions placed = fit.pose.apply(model.evaluate(fit.coefficients));
  std::vector<double> distances;
  for (const std::uint32_t v : probes) {
    const auto place = scan.nearest(placed.row(v).transpose(), 1e300);
    if (!place.is_on_boundary) distances.push_back(place.distance / fit.pose.scale);
  }
  if (!distances.empty()) fit.median_distance_mm = nth_smallest(distances, distances.size() / 2);
  return fit;
}

}  // namespace crowdface
