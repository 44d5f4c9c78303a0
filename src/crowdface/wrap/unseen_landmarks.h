// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "crowdface/wrap/wrap.h"

namespace crowdface {

/// How far each landmark ends from where it was picked when the wrap does not know it, in mm: an estimate of how well
/// places correspond where none was picked, the error of picking along. One more wrap for each of up to eleven
/// landmarks, four more for others; nothing where too few would be left.
/// \param shape, model, scan, landmarks, hint, options  as wrap takes them
std::map<std::string, double> unseen_landmarks(const WrapTemplate& shape, const ShapeModel* model,
                                               const Scan& scan,
                                               const std::vector<WrapLandmark>& landmarks,
                                               const std::optional<PoseHint>& hint,
                                               const WrapOptions& options = {});

}  // namespace crowdface
