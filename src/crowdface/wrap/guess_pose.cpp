// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/guess_pose.h"

#include <array>

#include <Eigen/Geometry>

#include "crowdface/mesh/vector3.h"
#include "crowdface/wrap/scan.h"
#include "crowdface/wrap/shape_fit.h"

namespace crowdface {
namespace {

/// A matrix whose columns are the side, up and front directions of a head.
Eigen::Matrix3d frame_of(const Eigen::Vector3d& up, const Eigen::Vector3d& front) {
  Eigen::Matrix3d frame;
  frame << up.cross(front), up, front;
  return frame;
}

/// The bounding box, along the axes of a frame, of the positions for which `used` is true.
Eigen::AlignedBox3d extent_of(const Positions& positions, const std::vector<bool>& used,
                              const Eigen::Matrix3d& frame) {
  Eigen::AlignedBox3d extent;
  for (Index v = 0; v < positions.rows(); ++v) {
    if (!used[static_cast<std::size_t>(v)]) continue;
    extent.extend(Eigen::Vector3d(frame.transpose() * positions.row(v).transpose()));
  }
  return extent;
}

ShapeFit best_fit(const SkinMesh& skin, const Positions& rest_positions, const HeadAxes& axes,
                  const ScanSurface& scan, const PoseHint& hint) {
  constexpr std::array kLower = {0.0, 0.12, -0.12};  // offsets as fractions of the head's height
  const Eigen::Matrix3d from = frame_of(axes.up, axes.front), to = frame_of(hint.up, hint.front);
  const Eigen::AlignedBox3d head =
      extent_of(rest_positions,
                std::vector<bool>(static_cast<std::size_t>(rest_positions.rows()), true), from);
  const Eigen::AlignedBox3d found =
      extent_of(scan.scan().positions, is_vertex_used(scan.scan()), to);
  const ShapeFitOptions options{.search_radii_mm = {40, 30, 20, 12}, .steps_per_round = 4};
  ShapeFit best;
  best.median_distance_mm = 1e300;
  // Try several scales near the width of the scan divided by the width of the template's head. The
  // ratio of the heights tells nothing, because scans end at different heights below the head. For
  // each scale, align the top and the foremost point of the template's head with the top and the
  // foremost point of the scan, with several vertical offsets.
  for (const double wider : {1.0, 0.85, 1.15}) {
    for (const double lower : kLower) {
      Similarity pose;
      pose.rotation = to * from.transpose();
      pose.scale = wider * found.sizes().x() / head.sizes().x();
      Eigen::Vector3d anchor_from(head.center().x(), head.max().y(), head.max().z());
      const Eigen::Vector3d anchor_to(found.center().x(), found.max().y(), found.max().z());
      anchor_from.y() += lower * head.sizes().y();
      pose.translation = to * anchor_to - pose.scale * (to * anchor_from);
      ShapeFit start;
      start.pose = pose;
      const ShapeFit fit = fit_shape(skin, {rest_positions, {}}, scan, {}, start, options);
      if (fit.median_distance_mm < best.median_distance_mm) best = fit;
    }
  }
  return best;
}

}  // namespace

Similarity guess_pose(const SkinMesh& skin, const Positions& rest_positions, const HeadAxes& axes,
                      const ScanSurface& scan, const PoseHint& hint,
                      const std::optional<ReliefMatch>& face) {
  if (!face || !hint.face) return best_fit(skin, rest_positions, axes, scan, hint).pose;
  ShapeFit start;
  start.pose = pose_of_faces(*face, *hint.face);
  return fit_shape(skin, {rest_positions, {}}, scan, {}, start,
                   {.search_radii_mm = {25, 20, 16, 12}, .steps_per_round = 4})
      .pose;
}

Similarity pose_of_faces(const ReliefMatch& template_face, const ReliefMatch& scan_face) {
  Similarity pose;
  pose.scale = scan_face.scale / template_face.scale;
  pose.rotation = frame_of(scan_face.axes.up, scan_face.axes.front) *
                  frame_of(template_face.axes.up, template_face.axes.front).transpose();
  pose.translation =
      scan_face.eye_midpoint - pose.scale * (pose.rotation * template_face.eye_midpoint);
  return pose;
}

}  // namespace crowdface
