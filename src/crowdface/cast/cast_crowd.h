// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/cast/crowd_cast.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"

namespace crowdface {

/// Casts the crowd: hand-written recipes in their order, then families, then the sampled faces, each
/// judged before it joins; then the reviews, one after the other. Each face gets its nearest head
/// and the nearest face that was there before it. Effort is bounded; what cannot be met ends in a
/// shortfall, not in an exception.
/// \param joined  called after each sampled face.
/// \throws InvalidInput if a family or a review names a face that is not there.
CrowdCast cast_crowd(const Casting& casting, const FaceJudge& judge, const FaceJoined& joined = {});

/// The nearest head and the nearest face before it, for each face of a crowd.
void find_nearest(const FaceJudge& judge, CrowdCast& cast);

}  // namespace crowdface
