// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/sampling.h"

namespace crowdface {

/// Ages a face: in every region, a share |age| of the weights moves to the heads tagged old (age
/// above 0) or young (below 0), in equal parts; the other weights keep the rest. The paper does the
/// same when it transfers an older person's detail to a younger one (Fig. 2). Each band takes its
/// `ageing` times this share. The weights no longer correspond to a position, so the positions are
/// removed.
///
/// \throws BrokenPrecondition if no head has the tag.
void apply_age(FacePlan& face, double age, const SamplingOptions& sampling);

/// Undoes apply_age, so that children can inherit from the face without its age. A band whose whole
/// weight was moved (age −1 or 1) cannot be restored; then the band and the face's age stay.
void take_back_age(FacePlan& face, const SamplingOptions& sampling);

/// Returns (1 − t)·a + t·b, head by head.
std::vector<SourceWeight> mixed_weights(const std::vector<SourceWeight>& a,
                                        const std::vector<SourceWeight>& b, double t);

}  // namespace crowdface
