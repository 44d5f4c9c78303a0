// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "crowdface/wrap/guess_pose.h"
#include "crowdface/wrap/scan.h"
#include "crowdface/wrap/wrap.h"

namespace crowdface {

/// Landmarks that the shapes of a template and of a scan tell, where it is known which way the scan looks: middle of
/// nose, lips and chin, and of heads with eyeballs corners of eyes and lids. None where no face is found, or where they
/// do not lie about as the template's do.
/// \param here  of the template, see propose_landmarks
std::vector<WrapLandmark> find_landmarks(const WrapTemplate& shape,
                                         const std::map<std::string, std::uint32_t>& here,
                                         const Scan& scan, const PoseHint& hint);

}  // namespace crowdface
