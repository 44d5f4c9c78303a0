// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/scan_face.h"

#include "crowdface/mesh/triangles.h"
#include "crowdface/paint/face_marks.h"

namespace crowdface {

std::optional<ReliefMatch> find_scan_face(const Scan& scan, const std::optional<PoseHint>& hint) {
  std::vector<HeadAxes> axes;
  if (hint) {
    axes.push_back({hint->front, hint->up});
  } else {
    for (const Bearing& bearing : all_bearings()) axes.push_back(axes_of(bearing));
  }
  const std::vector<bool> all(static_cast<std::size_t>(scan.positions.rows()), true);
  const Positions samples = sample_skin(topology_of(scan.triangles, scan.positions.rows()),
                                        scan.positions, all, kSkinSamples);
  auto match = match_relief(samples, axes, {});
  if (match && match->votes < kLeastVotes) match.reset();
  return match;
}

Similarity pose_of_faces(const ReliefMatch& of_template, const ReliefMatch& of_scan) {
  const auto frame = [](const HeadAxes& axes) {
    Eigen::Matrix3d columns;
    columns << axes.side(), axes.up, axes.front;
    return columns;
  };
  Similarity pose;
  pose.scale = of_scan.scale / of_template.scale;
  pose.rotation = frame(of_scan.axes) * frame(of_template.axes).transpose();
  pose.translation = of_scan.between - pose.scale * (pose.rotation * of_template.between);
  return pose;
}

}  // namespace crowdface
