// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/cast/casting_result.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"

namespace crowdface {

/// Casts a crowd: hand-written recipes in their order, then families, then sampled faces; each face
/// is judged before it joins the crowd. Applies the reviews in their order, each review as soon as
/// the reviewed faces are cast; with `mode: spread`, all reviews after the last face. Each face
/// records its nearest head and the nearest earlier face. The number of attempts is bounded. If
/// constraints cannot be met, the result has a shortfall; no exception is thrown.
///
/// \param joined  Called after each sampled face.
/// \throws InvalidInput if a family or a review names a face that does not exist.
CastingResult cast_crowd(const CastingOptions& casting, const FaceJudge& judge,
                         const FaceJoined& joined = {});

/// Finds the nearest head and the nearest earlier face for each face of a crowd from face `first`
/// on, counted from 0.
void find_nearest(const FaceJudge& judge, CastingResult& cast, std::size_t first = 0);

}  // namespace crowdface
