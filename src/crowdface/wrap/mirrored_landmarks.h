// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/wrap/shape_fit.h"

namespace crowdface {

/// Rejects mirrored landmarks.
/// \throws InvalidInput if the landmarks fit several times better after a reflection, because the
///     scan is mirrored or because left and right names are exchanged; the message names the more
///     likely cause. Fewer than five landmarks cannot show a reflection and are accepted.
/// \param positions  in millimetres; the landmarks' vertices are rows of this matrix.
void refuse_mirrored_landmarks(const Positions& positions,
                               const std::vector<WrapLandmark>& landmarks);

/// Rejects landmarks if the positions of two of them are probably swapped.
/// \throws InvalidInput if the landmarks fit several times better after the positions of one pair
///     on the scan are exchanged; the message names the pair. Fewer than five landmarks are
///     accepted.
/// \param positions  as for refuse_mirrored_landmarks.
void refuse_swapped_pair(const Positions& positions, const std::vector<WrapLandmark>& landmarks);

}  // namespace crowdface
