// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/suggested_places.h"

#include <algorithm>
#include <cmath>

#include <Eigen/SVD>

#include "crowdface/mesh/vector3.h"
#include "crowdface/pick/landmark_names.h"
#include "crowdface/wrap/shape_fit.h"

namespace crowdface {
namespace {

constexpr std::size_t kMinPairs = 3;

struct Pair {
  std::string name;
  Eigen::Vector3d from, to;
};

std::vector<Pair> pairs_of(const std::vector<PickedLandmark>& landmarks,
                           const Positions& template_positions) {
  std::vector<Pair> pairs;
  for (const PickedLandmark& landmark : landmarks) {
    if (!landmark.template_vertex || !landmark.scan_point) continue;
    pairs.push_back(
        {landmark.name, row3(template_positions, *landmark.template_vertex), *landmark.scan_point});
  }
  return pairs;
}

/// Whether the points determine a rotation. Points on one line do not.
bool determine_rotation(const Positions& places) {
  constexpr double kMinRatio = 0.1;
  const Positions centred = places.rowwise() - places.colwise().mean();
  const Eigen::Vector3d values = Eigen::JacobiSVD<Eigen::MatrixXd>(centred).singularValues();
  return values(1) > kMinRatio * values(0);
}

/// Fits the similarity transform from template to scan to the landmark pairs whose flag in `used`
/// is set, except the pair with index `without`.
std::optional<Similarity> fit(const std::vector<Pair>& pairs, const std::vector<bool>& used,
                              std::size_t without) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (used[i] && i != without) rows.push_back(i);
  }
  if (rows.size() < kMinPairs) return std::nullopt;
  const auto count = static_cast<Index>(rows.size());
  Positions from(count, 3), to(count, 3);
  for (Index r = 0; r < count; ++r) {
    const Pair& pair = pairs[rows[static_cast<std::size_t>(r)]];
    from.row(r) = pair.from.transpose();
    to.row(r) = pair.to.transpose();
  }
  if (!determine_rotation(from) || !determine_rotation(to)) return std::nullopt;
  return fit_similarity(from, to, ScaleFit::kUniform);
}

std::vector<double> residuals_of(const std::vector<Pair>& pairs, const std::vector<bool>& used,
                                 const Similarity& whole) {
  std::vector<double> residuals;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Similarity pose = fit(pairs, used, i).value_or(whole);
    residuals.push_back((apply_similarity(pose, pairs[i].from) - pairs[i].to).norm() / pose.scale);
  }
  return residuals;
}

/// Returns the index of the landmark pair (see LandmarkPose::Residual) whose residual is far larger
/// than the residuals of the other used pairs. Returns residuals.size() if there is no such pair,
/// or if there are fewer than five used pairs.
/// \param used  for each pair: whether it counts
std::size_t farthest_outlier(const std::vector<double>& residuals, const std::vector<bool>& used) {
  // An outlier has a residual above both kMinMm and kTimes times the median residual. Without
  // errors, corresponding points of two faces differ by about 5 mm after a fit.
  constexpr double kMinMm = 15, kTimes = 3;
  std::vector<double> sorted;
  std::size_t farthest = residuals.size();
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (!used[i]) continue;
    sorted.push_back(residuals[i]);
    if (farthest == residuals.size() || residuals[i] > residuals[farthest]) farthest = i;
  }
  constexpr std::size_t kMinToJudge = 5;
  if (sorted.size() < kMinToJudge) return residuals.size();
  std::sort(sorted.begin(), sorted.end());
  const double most = std::max(kMinMm, kTimes * sorted[(sorted.size() - 1) / 2]);
  return residuals[farthest] > most ? farthest : residuals.size();
}

/// Returns a correction for the position on the scan to which `pose` maps `place`. A pair is a
/// landmark of the template and the same landmark of the scan; the pair's residual is the scan's
/// landmark minus the mapped landmark of the template. The correction is the mean of the residuals,
/// with Gaussian weights around `place`. It corrects for local differences between faces. A
/// constant in the divisor (kHeld) lets the correction fade to zero far from all landmarks.
Eigen::Vector3d correction(const std::vector<Pair>& pairs, const LandmarkPose& pose,
                           const Eigen::Vector3d& place) {
  constexpr double kReachMm = 25, kHeld = 0.5;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = kHeld;
  for (const Pair& pair : pairs) {
    if (pose.residuals.at(pair.name).is_outlier) continue;
    const double weight = std::exp(-(pair.from - place).squaredNorm() / (2 * kReachMm * kReachMm));
    sum += weight * (pair.to - apply_similarity(pose.pose, pair.from));
    weights += weight;
  }
  return sum / weights;
}

/// Moves a point inside a nostril to the outer skin, if the outer skin is at most `depth` away.
std::optional<PickedPlace> outermost(const PickableMesh& mesh,
                                     const std::optional<PickedPlace>& place, double depth) {
  if (!place) return place;
  const auto outside = mesh.cast_ray(place->point + depth * place->normal, -place->normal, 0);
  return outside && outside->normal.dot(place->normal) > 0 ? outside : place;
}

/// Likely template vertices for names that are not picked: the mirror image of a picked landmark,
/// otherwise an entry of `proposals`.
std::map<std::string, PickedPlace> suggest_on_template(
    const std::vector<PickedLandmark>& landmarks, const PickableMesh& mesh,
    const MirrorPlane& plane, const std::map<std::string, std::uint32_t>& proposals) {
  constexpr double kReachMm = 20;
  std::map<std::string, PickedPlace> places;
  for (const auto& [name, vertex] : proposals) places[name] = mesh.place_at_vertex(vertex);
  for (const PickedLandmark& landmark : landmarks) {
    const auto other = landmark.template_vertex ? mirrored_name(landmark.name) : std::nullopt;
    if (!other) continue;
    const PickedPlace here = mesh.place_at_vertex(*landmark.template_vertex);
    const Eigen::Vector3d facing = here.normal - 2 * plane.normal.dot(here.normal) * plane.normal;
    const auto there = mesh.nearest(plane.mirrored(here.point), facing, kMinNormalCosine, kReachMm);
    if (there) places[*other] = mesh.place_at_vertex(there->vertex);
  }
  for (const PickedLandmark& landmark : landmarks) {
    if (landmark.template_vertex) places.erase(landmark.name);
  }
  return places;
}

}  // namespace

std::optional<LandmarkPose> fit_pose_to_picked(const std::vector<PickedLandmark>& landmarks,
                                               const Positions& template_positions) {
  const std::vector<Pair> pairs = pairs_of(landmarks, template_positions);
  std::vector<bool> used(pairs.size(), true);
  LandmarkPose result;
  std::vector<double> residuals;
  while (true) {
    const auto whole = fit(pairs, used, pairs.size());
    if (!whole) return std::nullopt;
    result.pose = *whole;
    residuals = residuals_of(pairs, used, *whole);
    const std::size_t outlier = farthest_outlier(residuals, used);
    if (outlier == pairs.size()) break;
    used[outlier] = false;
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    result.residuals[pairs[i].name] = {residuals[i], !used[i]};
  }
  return result;
}

SuggestedPlaces suggest_places(const std::vector<PickedLandmark>& landmarks,
                               const PickableMesh& template_mesh, const PickableMesh& scan_mesh,
                               const MirrorPlane& plane,
                               const std::map<std::string, std::uint32_t>& proposals) {
  constexpr double kMinFacing = 0.3, kReachMm = 25, kDepthMm = 5;
  SuggestedPlaces suggested;
  suggested.template_places = suggest_on_template(landmarks, template_mesh, plane, proposals);
  suggested.pose = fit_pose_to_picked(landmarks, template_mesh.positions());
  if (!suggested.pose) return suggested;

  std::map<std::string, PickedPlace> wanted = suggested.template_places;
  for (const PickedLandmark& landmark : landmarks) {
    if (landmark.template_vertex)
      wanted[landmark.name] = template_mesh.place_at_vertex(*landmark.template_vertex);
    if (landmark.scan_point) wanted.erase(landmark.name);
  }
  const std::vector<Pair> pairs = pairs_of(landmarks, template_mesh.positions());
  const Similarity& pose = suggested.pose->pose;
  for (const auto& [name, place] : wanted) {
    const Eigen::Vector3d point =
        apply_similarity(pose, place.point) + correction(pairs, *suggested.pose, place.point);
    const auto near = outermost(
        scan_mesh,
        scan_mesh.nearest(point, pose.rotation * place.normal, kMinFacing, kReachMm * pose.scale),
        kDepthMm * pose.scale);
    if (near) suggested.scan_places[name] = *near;
  }
  return suggested;
}

}  // namespace crowdface
