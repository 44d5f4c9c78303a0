// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/paint/face_relief.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/wrap/scan_surface.h"
#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// The orientation of the head in a scan without landmarks.
struct PoseHint {
  Eigen::Vector3d up, front;  ///< directions of the head: unit vectors in the scan's frame
  /// The face found on the scan; nothing: not yet searched or not found.
  std::optional<ReliefMatch> face = {};
};

/// Estimates the similarity from a template to a scan without landmarks. If the relief shows where
/// the face is on the template and on the scan, the function aligns these two faces and refines the
/// pose with closest points. Otherwise the function aligns the tops of the heads with several
/// scales and offsets, refines each pose with closest points, and returns the pose with the
/// smallest distances.
/// \param rest_positions  positions of the template's skin, in millimetres
/// \param axes  axes of the template
/// \param hint  may contain the face of the scan
/// \param face  face of the template's skin, found by its relief
Similarity guess_pose(const SkinMesh& skin, const Positions& rest_positions, const HeadAxes& axes,
                      const ScanSurface& scan, const PoseHint& hint,
                      const std::optional<ReliefMatch>& face);

/// The similarity that aligns the face found on a template with the face found on a scan.
Similarity pose_of_faces(const ReliefMatch& template_face, const ReliefMatch& scan_face);

}  // namespace crowdface
