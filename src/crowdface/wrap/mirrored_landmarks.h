// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/wrap/shape_fit.h"

namespace crowdface {

/// \throws InvalidInput if landmarks fit several times better after a reflection: because the scan is mirrored, or because
/// names of left and right are exchanged; whichever fits better is named.
/// \param positions  mm, of what the landmarks' rows are of; at least four landmarks
void refuse_mirrored_landmarks(const Positions& positions,
                               const std::vector<WrapLandmark>& landmarks);

}  // namespace crowdface
