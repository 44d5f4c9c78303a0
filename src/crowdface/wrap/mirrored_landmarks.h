// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/wrap/shape_fit.h"

namespace crowdface {

/// Rejects mirrored landmarks.
/// \throws InvalidInput if the landmarks fit several times better after a reflection, because the
///     scan is mirrored or because left and right names are exchanged; the message names the more
///     likely cause. If there are fewer than five landmarks, they cannot show a reflection, and the
///     function accepts them.
/// \param positions  in millimetres; the landmarks' vertices are rows of this matrix.
void refuse_mirrored_landmarks(const Positions& positions,
                               const std::vector<WrapLandmark>& landmarks);

/// Rejects landmarks if the positions of two of them are probably swapped.
/// \throws InvalidInput if the landmarks fit several times better after the positions of one pair
///     on the scan are exchanged; the message names the pair. If there are fewer than five
///     landmarks, the function accepts them without a check.
/// \param positions  as for refuse_mirrored_landmarks.
void refuse_swapped_pair(const Positions& positions, const std::vector<WrapLandmark>& landmarks);

}  // namespace crowdface
