// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/wrap/guess_pose.h"
#include "crowdface/wrap/scan.h"
#include "crowdface/wrap/shape_fit.h"
#include "crowdface/wrap/wrap_template.h"

namespace crowdface {

/// Landmarks that the shapes of a template and of a scan tell, where it is known which way the scan looks: middle of nose, lips and
/// chin, and of heads with eyeballs corners of eyes and lids (propose_landmarks). None where no face is found, or
/// where they do not lie about as the template's do.
std::vector<WrapLandmark> find_landmarks(const WrapTemplate& shape, const Scan& scan,
                                         const PoseHint& hint);

}  // namespace crowdface
