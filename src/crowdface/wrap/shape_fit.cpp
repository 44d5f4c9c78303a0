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

constexpr std::size_t kMostProbes = 4000;  ///< vertices asked in each step
constexpr double kOpenEnough = 0.3;
constexpr double kLeastCosine = 0.5;
constexpr double kKept = 0.8;  ///< of the probes that found something
constexpr Index kPoseUnknowns = 7;
constexpr double kGrowth = 0.02;  ///< by which a scale still changes once a model is fitted

/// A vertex and what it found on the scan, in millimetres of the template.
struct Match {
  std::uint32_t vertex = kNoIndex;
  Eigen::Vector3d offset;  ///< from where the vertex is to what it found
  Eigen::Vector3d normal;  ///< of the scan there
  double distance;
};

std::vector<std::uint32_t> choose_probes(const SkinMesh& skin) {
  std::vector<std::uint32_t> open;
  for (std::uint32_t v = 0; v < skin.vertices.size(); ++v) {
    if (skin.openness[v] > kOpenEnough) open.push_back(v);
  }
  return some_of(open, kMostProbes);
}

std::vector<Match> find_matches(const Positions& placed, const Positions& normals,
                                const ScanSurface& scan, const std::vector<std::uint32_t>& probes,
                                double reach) {
  std::vector<Match> matches(probes.size());
  parallel_for_each(probes.size(), 128, [&](std::size_t i) {
    const std::uint32_t v = probes[i];
    const Eigen::Vector3d point = row3(placed, v);
    const auto place = scan.nearest(point, row3(normals, v), kLeastCosine, reach);
    if (place.found) matches[i] = {v, place.point - point, place.normal, place.distance};
  });
  std::erase_if(matches, [](const Match& match) { return match.vertex == kNoIndex; });
  return matches;
}

void leave_out_farthest(std::vector<Match>& matches) {
  std::vector<double> distances;
  for (const Match& match : matches) distances.push_back(match.distance);
  const auto rank = static_cast<std::size_t>(kKept * static_cast<double>(distances.size() - 1));
  const double most = value_of_rank(std::move(distances), rank);
  std::erase_if(matches, [&](const Match& match) { return match.distance > most; });
}

/// The normal equations of one step: turn, shift, growth, then coefficients.
class Equations {
 public:
  explicit Equations(Index modes)
      : matrix_(Eigen::MatrixXd::Zero(kPoseUnknowns + modes, kPoseUnknowns + modes)),
        right_(Eigen::VectorXd::Zero(kPoseUnknowns + modes)) {}

  /// weight · (row · unknowns − value)²
  void add(const Eigen::VectorXd& row, double value, double weight) {
    for (Index i = 0; i < row.size(); ++i) {
      const double factor = weight * row(i);
      right_(i) += factor * value;
      for (Index j = 0; j <= i; ++j) matrix_(i, j) += factor * row(j);
    }
  }
  void hold(Index unknown, double value, double weight) {
    matrix_(unknown, unknown) += weight;
    right_(unknown) += weight * value;
  }
  Eigen::VectorXd solve() const {
    return Eigen::LDLT<Eigen::MatrixXd, Eigen::Lower>(matrix_).solve(right_);
  }

 private:
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_;
};

/// How a point moves along a direction with the unknowns; lengths in the scan's unit.
Eigen::VectorXd row_of(const ShapeModel& model, const ShapeFit& fit, std::uint32_t vertex,
                       const Eigen::Vector3d& arm, const Eigen::Vector3d& direction) {
  Eigen::VectorXd row(kPoseUnknowns + static_cast<Index>(model.modes.size()));
  row.head<3>() = cross3(arm, direction);
  row.segment<3>(3) = direction;
  row(6) = dot3(arm, direction);
  const Eigen::Vector3d turned = fit.pose.scale * (fit.pose.rotation.transpose() * direction);
  for (std::size_t k = 0; k < model.modes.size(); ++k) {
    row(kPoseUnknowns + static_cast<Index>(k)) =
        dot3(model.modes[k].row(vertex).transpose(), turned);
  }
  return row;
}

void apply(const Eigen::VectorXd& step, const Eigen::Vector3d& middle, ShapeFit& fit) {
  const Eigen::Vector3d turn = step.head<3>();
  const double angle = length3(turn);
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

/// One step of Gauss and Newton. \return how many places were found.
std::size_t step(const SkinMesh& skin, const ShapeModel& model, const ScanSurface& scan,
                 const std::vector<WrapLandmark>& landmarks,
                 const std::vector<std::uint32_t>& probes, double reach_mm,
                 const ShapeFitOptions& options, double first_scale, ShapeFit& fit) {
  const Positions placed = fit.pose.apply(model.shape(fit.coefficients));
  std::vector<Match> matches = find_matches(placed, vertex_normals(skin.triangles, placed), scan,
                                            probes, reach_mm * fit.pose.scale);
  if (matches.size() < probes.size() / 50 + 3) return 0;
  leave_out_farthest(matches);
  const double mm = fit.pose.scale;  // in the scan's unit
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Match& match : matches) middle += placed.row(match.vertex).transpose();
  middle /= static_cast<double>(matches.size());
  const auto modes = static_cast<Index>(model.modes.size());
  Equations equations(modes);
  const double weight = options.measurements / (static_cast<double>(matches.size()) * mm * mm);
  for (const Match& match : matches) {
    const Eigen::Vector3d arm = placed.row(match.vertex).transpose() - middle;
    equations.add(row_of(model, fit, match.vertex, arm, match.normal),
                  dot3(match.normal, match.offset), weight * (1 - options.tangential));
    if (options.tangential == 0) continue;
    for (Index axis = 0; axis < 3; ++axis) {
      equations.add(row_of(model, fit, match.vertex, arm, Eigen::Vector3d::Unit(axis)),
                    match.offset(axis), weight * options.tangential);
    }
  }
  const double for_landmarks = landmarks.empty()
                                   ? 0
                                   : options.landmark_weight * options.measurements /
                                         (static_cast<double>(landmarks.size()) * mm * mm);
  for (const WrapLandmark& landmark : landmarks) {
    const Eigen::Vector3d point = placed.row(landmark.vertex).transpose();
    for (Index axis = 0; axis < 3; ++axis) {
      equations.add(
          row_of(model, fit, landmark.vertex, point - middle, Eigen::Vector3d::Unit(axis)),
          landmark.place(axis) - point(axis), for_landmarks);
    }
  }
  for (Index k = 0; k < modes; ++k) equations.hold(kPoseUnknowns + k, -fit.coefficients(k), 1);
  if (modes > 0) {  // people differ in size: that is the model's business
    equations.hold(6, 1 - fit.pose.scale / first_scale, 1 / (kGrowth * kGrowth));
  }
  // Where the surface says nothing of a turn (a ball), nothing is turned.
  for (Index k = 0; k < kPoseUnknowns; ++k) equations.hold(k, 0, 1e-9);
  apply(equations.solve(), middle, fit);
  return matches.size();
}

}  // namespace

ShapeFit fit_shape(const SkinMesh& skin, const ShapeModel& model, const ScanSurface& scan,
                   const std::vector<WrapLandmark>& landmarks, const ShapeFit& start,
                   const ShapeFitOptions& options) {
  const std::vector<std::uint32_t> probes = choose_probes(skin);
  ShapeFit fit = start;
  fit.coefficients.conservativeResizeLike(
      Eigen::VectorXd::Zero(static_cast<Index>(model.modes.size())));
  for (const double reach : options.reach_mm) {
    for (int i = 0; i < options.steps; ++i) {
      throw_if_interrupted();
      if (step(skin, model, scan, landmarks, probes, reach, options, start.pose.scale, fit) == 0)
        break;
    }
  }
  const Positions placed = fit.pose.apply(model.shape(fit.coefficients));
  std::vector<double> distances;
  for (const std::uint32_t v : probes) {
    const auto place = scan.nearest(placed.row(v).transpose(), 1e300);
    if (!place.on_rim) distances.push_back(place.distance / fit.pose.scale);
  }
  if (!distances.empty()) fit.residual = value_of_rank(distances, distances.size() / 2);
  return fit;
}

}  // namespace crowdface
