// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/cast/cast_face.h"
#include "crowdface/cast/sampling.h"

namespace crowdface {

/// Moves a face along the detail of heads tagged old (age above 0) or young (below 0), as the paper
/// does when it carries an older person's detail over to a younger one (Fig. 2): in every region a
/// share |age| of the weights goes to those heads, evenly, and what was there keeps the rest; of bands
/// each takes its `ageing` of that. The weights no longer come from a position then, so there is none.
/// \throws BrokenPrecondition if no head is tagged so.
void apply_age(CastFace& face, double age, const SamplingOptions& sampling);

/// The face before apply_age, of whom a child takes after: of an age of −1 or 1 nothing is known.
void take_back_age(CastFace& face, const SamplingOptions& sampling);

/// (1 − t)·a + t·b, head by head.
std::vector<SourceWeight> mixed_weights(const std::vector<SourceWeight>& a,
                                        const std::vector<SourceWeight>& b, double t);

}  // namespace crowdface
