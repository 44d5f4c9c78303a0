// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/sampling.h"

namespace crowdface {

/// Ages a face: in every region, the fraction |age| of the weights moves to the heads tagged old
/// (age above 0) or young (below 0), in equal parts; the remaining weights are scaled by 1 − |age|.
/// The paper does the same when it transfers an older person's detail to a younger one (Fig. 2). A
/// band multiplies this fraction by its `ageing`. The weights no longer correspond to a position,
/// so the positions are removed.
///
/// \throws BrokenPrecondition if no head has the tag.
void apply_age(FacePlan& face, double age, const SamplingOptions& sampling);

/// Undoes apply_age, so that children do not inherit the age of this face. If age −1 or 1 moved the
/// whole weight of a band, the band cannot be restored; the band and the face's age then stay as
/// they are.
void take_back_age(FacePlan& face, const SamplingOptions& sampling);

/// Returns (1 − t)·a + t·b, head by head.
std::vector<SourceWeight> mixed_weights(const std::vector<SourceWeight>& a,
                                        const std::vector<SourceWeight>& b, double t);

}  // namespace crowdface
