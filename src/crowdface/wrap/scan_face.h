// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/wrap/guess_pose.h"
#include "crowdface/wrap/scan.h"

namespace crowdface {

/// The face of a scan, found by its relief (see match_relief).
/// \param hint  how it stands, within some 35°; without it all turns are searched
/// \return nothing if no part has the relief of a face
std::optional<ReliefMatch> find_scan_face(const Scan& scan, const std::optional<PoseHint>& hint);

}  // namespace crowdface
