// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/paint/face_relief.h"
#include "crowdface/wrap/guess_pose.h"
#include "crowdface/wrap/scan.h"

namespace crowdface {

/// The face of a scan, found by its relief (see match_relief).
/// \param hint  how the scan stands, within some 35°; without it all turns are searched
/// \return nothing if no part of the scan has the relief of a face
std::optional<ReliefMatch> find_scan_face(const Scan& scan, const std::optional<PoseHint>& hint);

/// The similarity that lays the face found on a template on the face found on a scan.
Similarity pose_of_faces(const ReliefMatch& of_template, const ReliefMatch& of_scan);

}  // namespace crowdface
