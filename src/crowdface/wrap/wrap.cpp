// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/wrap.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/find_mirror.h"
#include "crowdface/parts/follower.h"
#include "crowdface/wrap/guess_pose.h"
#include "crowdface/wrap/unfold.h"

namespace crowdface {
namespace {

constexpr double kMirroredShare = 0.9;  ///< of the vertices: with fewer a head is no mirror image
constexpr double kLeastOutlierMm = 4, kOutlier = 3.5;  ///< the latter in medians

/// Landmarks by rows of the skin.
std::vector<WrapLandmark> on_skin(const SkinMesh& skin,
                                  const std::vector<WrapLandmark>& landmarks) {
  std::vector<WrapLandmark> result;
  for (const WrapLandmark& landmark : landmarks) {
    const auto at = std::lower_bound(skin.vertices.begin(), skin.vertices.end(), landmark.vertex);
    if (at == skin.vertices.end() || *at != landmark.vertex) continue;
    result.push_back(landmark);
    result.back().vertex = static_cast<std::uint32_t>(at - skin.vertices.begin());
  }
  return result;
}

/// How far the landmarks are off after a similarity.
std::vector<LandmarkResidual> residuals_of(const Positions& skin, const Similarity& pose,
                                           const std::vector<WrapLandmark>& landmarks) {
  std::vector<LandmarkResidual> result;
  for (const WrapLandmark& landmark : landmarks) {
    const Eigen::Vector3d point = skin.row(landmark.vertex).transpose();
    result.push_back({landmark.name, length3(carried(pose, point) - landmark.place) / pose.scale});
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
  const double most = std::max(kLeastOutlierMm, kOutlier * sorted[sorted.size() / 2]);
  for (LandmarkResidual& residual : residuals) residual.outlier = residual.final_mm > most;
}

void move(std::vector<WrapLandmark>& landmarks, const Similarity& motion) {
  for (WrapLandmark& landmark : landmarks) {
    landmark.place = carried(motion, landmark.place);
  }
}

Scan moved_scan(const Scan& scan, const Similarity& motion) {
  return {motion.apply(scan.positions), scan.triangles};
}

void measure(const Positions& wrapped, const ScanSurface& scan, WrapResult& result) {
  result.distance_mm = Eigen::VectorXd::Zero(wrapped.rows());
  std::vector<char> on_rim(static_cast<std::size_t>(wrapped.rows()), 0);
  parallel_blocks(wrapped.rows(), 1024, [&](Index begin, Index end) {
    std::uint32_t before = kNoIndex;
    for (Index v = begin; v < end; ++v) {
      const auto place = scan.nearest(row3(wrapped, v), 1e300, before);
      before = place.triangle;
      result.distance_mm(v) = place.distance;
      on_rim[static_cast<std::size_t>(v)] = place.on_rim ? 1 : 0;
    }
  });
  result.without_data.assign(on_rim.begin(), on_rim.end());
}

/// A large skin, its model and its landmarks, as its reduced skin has them.
struct Small {
  Positions rest;
  std::optional<ShapeModel> model;
  std::vector<WrapLandmark> landmarks;  ///< moved along with the vertex that stands for theirs
};

Small reduce(const WrapTemplate& shape, const Positions& rest, const ShapeModel* model,
             const std::vector<WrapLandmark>& landmarks, const Similarity& pose) {
  const SkinMesh& mesh = shape.reduced->mesh;
  Small small{mesh.of(rest), std::nullopt, landmarks};
  if (model != nullptr) {
    small.model = ShapeModel{mesh.of(model->mean), {}};
    for (const Positions& mode : model->modes) small.model->modes.push_back(mesh.of(mode));
  }
  for (WrapLandmark& landmark : small.landmarks) {
    Index nearest = 0;
    (small.rest.rowwise() - rest.row(landmark.vertex)).rowwise().squaredNorm().minCoeff(&nearest);
    const Eigen::Vector3d beside =
        (small.rest.row(nearest) - rest.row(landmark.vertex)).transpose();
    landmark.vertex = static_cast<std::uint32_t>(nearest);
    landmark.place += pose.scale * (pose.rotation * beside);
  }
  return small;
}

Similarity first_pose(const SkinMesh& bent, const Positions& rest, const WrapTemplate& shape,
                      const ScanSurface& surface, const std::vector<WrapLandmark>& landmarks,
                      const std::optional<PoseHint>& hint) {
  if (landmarks.size() >= kFewestLandmarks) return pose_of_landmarks(rest, landmarks);
  if (!hint) {
    throw InvalidInput(concat("expected at least ", kFewestLandmarks,
                              " landmarks on template and scan, or which way the scan looks "
                              "(--scan-up, --scan-front), found ",
                              landmarks.size(), " landmarks"));
  }
  return guess_pose(bent, shape.reduced ? bent.of(rest) : rest, shape.axes, surface, *hint);
}

void refuse_no_pose(const Similarity& pose) {
  if (std::isfinite(pose.scale) && std::isfinite(1 / pose.scale) && pose.translation.allFinite() &&
      pose.rotation.allFinite()) {
    return;
  }
  throw InvalidInput(
      "template and scan cannot be laid on each other; are the landmarks in different places, and "
      "is the scan a head?");
}

}  // namespace

ShapeModel skin_model(const ShapeModel& heads, const WrapTemplate& shape) {
  const FoundMirror mirror =
      find_mirror(shape.topology, shape.components, heads.mean, shape.axes.side());
  const ShapeModel both =
      mirror.share() < kMirroredShare ? heads : with_mirror_images(heads, mirror.map);
  ShapeModel of_skin{shape.skin.of(both.mean), {}};
  for (const Positions& mode : both.modes) of_skin.modes.push_back(shape.skin.of(mode));
  return of_skin;
}

WrapResult wrap(const WrapTemplate& shape, const ShapeModel* model, const Scan& scan,
                const std::vector<WrapLandmark>& all_landmarks, const std::optional<PoseHint>& hint,
                const WrapOptions& options) {
  const SkinMesh& skin = shape.skin;
  const SkinMesh& bent = shape.reduced ? shape.reduced->mesh : skin;
  std::vector<WrapLandmark> landmarks = on_skin(skin, all_landmarks);
  const Positions rest = skin.of(shape.positions);
  WrapResult result;
  ShapeFit fit;
  std::optional<Small> small;
  const ShapeModel* used = nullptr;
  {
    const ScanSurface surface(scan);
    fit.pose = first_pose(bent, rest, shape, surface, landmarks, hint);
    if (shape.reduced) small = reduce(shape, rest, model, landmarks, fit.pose);
    const auto& marks = small ? small->landmarks : landmarks;
    const ShapeModel alone{small ? small->rest : rest, {}};
    fit = fit_shape(bent, alone, surface, marks, fit, options.pose);
    result.pose_residual_mm = fit.residual;
    result.landmarks = residuals_of(rest, fit.pose, landmarks);
    if (model != nullptr) {
      used = small ? &*small->model : model;
      fit = fit_shape(bent, *used, surface, marks, fit, options.person);
    }
  }
  result.pose = fit.pose;
  refuse_no_pose(fit.pose);
  const Similarity back = inverse(fit.pose);
  const ScanSurface surface(moved_scan(scan, back));
  move(landmarks, back);
  if (small) move(small->landmarks, back);
  const auto& marks = small ? small->landmarks : landmarks;
  Positions wrapped = small ? small->rest : rest;
  if (used != nullptr) {
    wrapped = regress_shape(bent, *used, used->shape(fit.coefficients), surface, marks,
                            options.regression);
  }
  wrapped = bend_skin(bent, wrapped, surface, marks,
                      used == nullptr ? options.bend : options.bend_with_model);
  if (small) {
    unfold(bent, small->rest, wrapped);
    wrapped = rest + shape.reduced->carry(wrapped - small->rest, skin);
  }
  DetailOptions detail = options.detail;
  if (small) detail.smoothings = shape.reduced->smoothings;
  wrapped = follow_detail(skin, rest, wrapped, surface, detail);
  result.flipped = unfold(skin, rest, wrapped);
  add_final(wrapped, landmarks, result.landmarks);
  measure(wrapped, surface, result);

  result.positions = shape.positions;
  for (Index v = 0; v < wrapped.rows(); ++v) {
    result.positions.row(skin.vertices[static_cast<std::size_t>(v)]) = wrapped.row(v);
  }
  const FaceSet faces{shape.topology, {}, {{"template", shape.positions}}};
  PartFollower(faces, shape.parts, shape.axes).follow(0, result.positions);
  return result;
}

}  // namespace crowdface
