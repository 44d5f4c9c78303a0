// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/paint/face_relief.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/wrap/scan_surface.h"
#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// Which way the head on a scan looks, where no landmarks tell: unit vectors in the scan's frame.
struct PoseHint {
  Eigen::Vector3d up, front;
  std::optional<ReliefMatch> face = {};  ///< of the scan, if it was found before
};

/// The similarity from a template to a scan without landmarks. If a face is found on both by its relief, the faces are laid
/// on each other and closest points do the rest; otherwise tops of heads are, in several sizes and places, and the pose is the
/// one from which closest points come nearest.
/// \param rest     of the skin, in millimetres
/// \param face  of the template's skin, found by its relief
/// \param hint  with the face of the scan
Similarity guess_pose(const SkinMesh& skin, const Positions& rest, const HeadAxes& axes,
                      const ScanSurface& scan, const PoseHint& hint,
                      const std::optional<ReliefMatch>& face);

/// The similarity that lays the face found on a template on the face found on a scan.
Similarity pose_of_faces(const ReliefMatch& of_template, const ReliefMatch& of_scan);

}  // namespace crowdface
