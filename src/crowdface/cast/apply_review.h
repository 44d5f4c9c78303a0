// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/cast/casting_result.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"

namespace crowdface {

/// Redraws the faces that a review rejects, so that each keeps its distance from all other faces,
/// and stores the review's notes. Faces that are not rejected do not change.
///
/// \throws InvalidInput if the review names a face that is not in the crowd.
void apply_review(const CastingOptions& casting, const FaceJudge& judge, const Review& review,
                  CastingResult& cast);

}  // namespace crowdface
