// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/scan_face.h"

#include "crowdface/mesh/triangles.h"
#include "crowdface/paint/face_marks.h"
#include "crowdface/wrap/centred_scan.h"

namespace crowdface {

std::optional<ReliefMatch> find_scan_face(const Scan& scan, const std::optional<PoseHint>& hint) {
  std::vector<HeadAxes> axes;
  if (hint) {
    axes.push_back({hint->front, hint->up});
  } else {
    for (const Orientation& orientation : all_orientations()) axes.push_back(axes_of(orientation));
  }
  const CentredScan moved = centre_scan(scan, {});
  const Index vertices = scan.positions.rows();
  const std::vector<bool> all(static_cast<std::size_t>(vertices), true);
  const Positions samples =
      sample_skin(topology_of(scan.triangles, vertices), moved.scan.positions, all, kSkinSamples);
  auto match = match_relief(samples, axes, {});
  if (match &&
      (match->score < kMinScore || (hint && match->rotation_degrees > kMaxRotationDegrees))) {
    match.reset();
  }
  if (match) match->eye_midpoint += moved.box_centre;
  return match;
}

}  // namespace crowdface
