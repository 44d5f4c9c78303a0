// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/wrap.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/parts/follower.h"
#include "crowdface/parts/vector3.h"
#include "crowdface/wrap/unfold.h"

namespace crowdface {
namespace {

constexpr std::size_t kFewestLandmarks = 4;
constexpr double kLeastOutlier_mm = 4, kOutlier = 3.5;  ///< the latter in medians

/// Landmarks by rows of the skin.
std::vector<WrapLandmark> on_skin(const SkinMesh& skin, const std::vector<WrapLandmark>& landmarks) {
  std::vector<WrapLandmark> result;
  for (const WrapLandmark& landmark : landmarks) {
    const auto at = std::lower_bound(skin.vertices.begin(), skin.vertices.end(), landmark.vertex);
    if (at == skin.vertices.end() || *at != landmark.vertex) continue;
    result.push_back(landmark);
    result.back().vertex = static_cast<std::uint32_t>(at - skin.vertices.begin());
  }
  return result;
}

Similarity pose_of_landmarks(const Positions& skin, const std::vector<WrapLandmark>& landmarks) {
  Positions from(static_cast<Index>(landmarks.size()), 3), to(from.rows(), 3);
  for (Index i = 0; i < from.rows(); ++i) {
    const WrapLandmark& landmark = landmarks[static_cast<std::size_t>(i)];
    from.row(i) = skin.row(landmark.vertex);
    to.row(i) = landmark.place.transpose();
  }
  return fit_similarity(from, to, ScaleFit::kUniform);
}

/// How far the landmarks are off after a similarity.
std::vector<LandmarkResidual> residuals_of(const Positions& skin, const Similarity& pose,
                                           const std::vector<WrapLandmark>& landmarks) {
  std::vector<LandmarkResidual> result;
  for (const WrapLandmark& landmark : landmarks) {
    const Eigen::Vector3d point = skin.row(landmark.vertex).transpose();
    const Eigen::Vector3d placed = pose.scale * (pose.rotation * point) + pose.translation;
    result.push_back({landmark.name, length3(placed - landmark.place) / pose.scale});
  }
  return result;
}

/// How far they are off in the end. A misplaced one is held where it belongs by the surface and by the
/// others, and so ends far from where it was picked.
void add_final(const Positions& wrapped, const std::vector<WrapLandmark>& landmarks,
               std::vector<LandmarkResidual>& residuals) {
  std::vector<double> sorted;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    residuals[i].final_mm =
        length3(wrapped.row(landmarks[i].vertex).transpose() - landmarks[i].place);
    sorted.push_back(residuals[i].final_mm);
  }
  if (sorted.empty()) return;
  std::sort(sorted.begin(), sorted.end());
  const double most = std::max(kLeastOutlier_mm, kOutlier * sorted[sorted.size() / 2]);
  for (LandmarkResidual& residual : residuals) residual.outlier = residual.final_mm > most;
}

Scan moved(const Scan& scan, const Similarity& motion) {
  return {motion.apply(scan.positions), scan.triangles};
}

void measure(const Positions& wrapped, const ScanSurface& scan,
             WrapResult& result) {
  result.distance_mm = Eigen::VectorXd::Zero(wrapped.rows());
  result.without_data.assign(static_cast<std::size_t>(wrapped.rows()), false);
  for (Index v = 0; v < wrapped.rows(); ++v) {
    const auto place = scan.nearest(wrapped.row(v).transpose(), 1e300);
    result.distance_mm(v) = place.distance;
    result.without_data[static_cast<std::size_t>(v)] = place.on_rim;
  }
}

}  // namespace

WrapResult wrap(const WrapTemplate& shape, const ShapeModel* model, const Scan& scan,
                const std::vector<WrapLandmark>& all_landmarks, const std::optional<PoseHint>& hint,
                const WrapOptions& options) {
  const SkinMesh& skin = shape.skin;
  std::vector<WrapLandmark> landmarks = on_skin(skin, all_landmarks);
  const Positions rest = skin.of(shape.positions);
  const ShapeModel alone{rest, {}};
  ShapeFit fit;
  if (landmarks.size() >= kFewestLandmarks) {
    fit.pose = pose_of_landmarks(rest, landmarks);
  } else if (!hint) {
    throw InvalidInput(concat("expected at least ", kFewestLandmarks,
                              " landmarks on template and scan, or which way the scan looks, found ",
                              landmarks.size(), " landmarks"));
  }
  WrapResult result;
  {
    const ScanSurface surface(scan);
    fit = fit_shape(skin, alone, surface, landmarks, fit, options.pose);
    result.pose_residual_mm = fit.residual;
    result.landmarks = residuals_of(rest, fit.pose, landmarks);
    if (model != nullptr) fit = fit_shape(skin, *model, surface, landmarks, fit, options.person);
  }
  result.pose = fit.pose;
  const Similarity back = inverse(fit.pose);
  const ScanSurface surface(moved(scan, back));
  for (WrapLandmark& landmark : landmarks) {
    landmark.place = back.scale * (back.rotation * landmark.place) + back.translation;
  }
  BendOptions bend = options.bend;
  if (model != nullptr) {
    std::erase_if(bend.stiffness_mm,
                  [&](double length) { return length > options.first_stiffness_with_model_mm; });
  }
  const ShapeModel& used = model != nullptr ? *model : alone;
  Positions wrapped =
      bend_skin(skin, used.shape(fit.coefficients), used, surface, landmarks, bend);
  wrapped = follow_detail(skin, wrapped, surface, options.detail);
  result.flipped = unfold(skin, rest, wrapped);
  add_final(wrapped, landmarks, result.landmarks);
  measure(wrapped, surface, result);

  FaceSet faces{shape.topology, {}, {{"template", shape.positions}}};
  result.positions = shape.positions;
  for (Index v = 0; v < wrapped.rows(); ++v) {
    result.positions.row(skin.vertices[static_cast<std::size_t>(v)]) = wrapped.row(v);
  }
  PartFollower(faces, shape.parts, shape.axes).follow(0, result.positions);
  return result;
}

}  // namespace crowdface
