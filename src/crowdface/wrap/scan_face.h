// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/wrap/guess_pose.h"
#include "crowdface/wrap/scan.h"

namespace crowdface {

/// Finds the face of a scan by its relief (see `match_relief`).
/// \param hint  the orientation, accurate to about 35°; without a hint the function searches all
/// orientations
/// \return nothing if no part of the scan has the relief of a face
std::optional<ReliefMatch> find_scan_face(const Scan& scan, const std::optional<PoseHint>& hint);

}  // namespace crowdface
