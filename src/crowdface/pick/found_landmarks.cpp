// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/found_landmarks.h"

#include <algorithm>
#include <array>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/pick/landmark_names.h"
#include "crowdface/pick/pickable_mesh.h"
#include "crowdface/pick/proposed_landmarks.h"
#include "crowdface/wrap/scan_face.h"

namespace crowdface {
namespace {

/// Largest distance between a found landmark and the same landmark of the template in the estimated
/// pose.
constexpr double kMaxPoseDistanceMm = 25;
/// Largest distance between a found landmark and the same landmark of the template, after a fit to
/// all landmarks. The differences between people's faces are smaller than this distance.
constexpr double kMaxFitDistanceMm = 14;
/// Assumed error of a found landmark: about twice the error that scripts/measure_wrap.sh measures
/// (1.3 to 2.4 mm), because the errors of neighbouring landmarks are correlated.
constexpr double kFoundErrorMm = 5;

/// Whether a landmark is found with the help of a separate eyeball: the landmarks of lids and of
/// corners of the eyes. The wrap takes such landmarks for as exact as picked landmarks.
bool is_at_eyeball(const std::string& name) {
  return name.starts_with("eye_") || name.starts_with("lid_");
}

/// Finds landmarks on a scan. Returns their points by name, in the coordinates of `scan`. Returns
/// nothing if the mesh cannot be a head, for example because it has too few vertices.
/// \param in_mm  the positions of the scan in millimetres.
/// \param axes   the axes of the head in `in_mm`.
std::map<std::string, Eigen::Vector3d> landmarks_of_scan(
    const Scan& scan, const Positions& in_mm, const HeadAxes& axes,
    const std::optional<ReliefMatch>& face = {}) {
  if (!in_mm.allFinite()) return {};
  try {
    std::map<std::string, Eigen::Vector3d> points;
    const WrapTemplate head =
        make_template(topology_of(scan.triangles, scan.positions.rows()), in_mm, axes, {}, face);
    for (const auto& [name, point] : find_face_landmarks(head).points)
      points[name] = point_on(scan.positions, point.corners, point.barycentric);
    return points;
  } catch (const InvalidInput&) {
    return {};
  }
}

/// Repeatedly removes the worst landmark, until a similarity transform maps all remaining landmarks
/// to within kMaxFitDistanceMm of the same landmarks of the template.
void drop_outliers(const WrapTemplate& wrap_template, std::vector<WrapLandmark>& landmarks) {
  while (landmarks.size() > kMinLandmarks) {
    const Similarity back = inverse(pose_of_landmarks(wrap_template.positions, landmarks));
    const auto off = [&](const WrapLandmark& landmark) {
      return (apply_similarity(back, landmark.scan_position) -
              row3(wrap_template.positions, landmark.vertex))
          .norm();
    };
    const auto worst = std::ranges::max_element(landmarks, {}, off);
    if (off(*worst) <= kMaxFitDistanceMm) return;
    landmarks.erase(worst);
  }
}

}  // namespace

std::vector<WrapLandmark> find_landmarks(
    const WrapTemplate& wrap_template,
    const std::map<std::string, std::uint32_t>& template_vertices, const Scan& scan,
    const PoseHint& given) {
  PoseHint hint = given;
  if (!hint.face) hint.face = find_scan_face(scan, hint);
  // Estimate the pose of the template on the scan.
  const SkinMesh& skin_mesh =
      wrap_template.reduced_skin ? wrap_template.reduced_skin->mesh : wrap_template.skin;
  Positions rest = wrap_template.skin.rows_of(wrap_template.positions);
  if (wrap_template.reduced_skin) rest = skin_mesh.rows_of(rest);
  const Similarity pose = guess_pose(skin_mesh, rest, wrap_template.axes, ScanSurface(scan), hint,
                                     wrap_template.face_match);
  const Similarity to_template = inverse(pose);
  const Positions placed = to_template.apply(scan.positions);
  std::optional<ReliefMatch> face = hint.face;
  if (face) {
    face->eye_midpoint /= pose.scale;
    face->scale /= pose.scale;
  }
  // Search with two sets of head axes, and keep the result with more landmarks. The axes of the
  // hint are inexact if the scan is rotated. The axes of the fitted pose are tilted if the scan
  // differs much from the template.
  const std::array candidates = {landmarks_of_scan(scan, scan.positions / pose.scale,
                                                   {.front = hint.front, .up = hint.up}, face),
                                 landmarks_of_scan(scan, placed, wrap_template.axes)};
  std::vector<WrapLandmark> most;
  for (const auto& of_scan : candidates) {
    std::vector<WrapLandmark> landmarks;
    for (const LandmarkDefinition& known : suggested_landmarks()) {
      const std::string name(known.name);
      const auto of_template = template_vertices.find(name);
      const auto found = of_scan.find(name);
      if (!known.is_found_on_scans || of_template == template_vertices.end() ||
          found == of_scan.end())
        continue;
      const std::uint32_t vertex = of_template->second;
      const Eigen::Vector3d& point = found->second;
      const Eigen::Vector3d placed_point = apply_similarity(to_template, point);
      if ((placed_point - row3(wrap_template.positions, vertex)).norm() > kMaxPoseDistanceMm)
        continue;
      landmarks.push_back(
          {name, vertex, point, true, is_at_eyeball(name) ? kPickedErrorMm : kFoundErrorMm});
    }
    drop_outliers(wrap_template, landmarks);
    if (landmarks.size() > most.size()) most = std::move(landmarks);
  }
  return most;
}

}  // namespace crowdface
