// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/cast/casting_result.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"

namespace crowdface {

/// Casts a crowd. Each candidate for a face passes through these steps:
///
/// 1. Draw: random_face_plan draws the values that are not given.
/// 2. Inherit: for a member of a family, FamilySampler mixes the drawn values with the values of
///    the parents and of the founder. For a variant, face_changes.cpp mixes them with the values of
///    the original.
/// 3. Age: apply_age moves weight to old or young heads.
/// 4. Limit: the heads and their weights are final, and FaceJudge checks them (check_recipe first).
///    FaceSearch (in spread mode: cast_spread) also checks the distances from the other faces.
///    RejectionReason lists all limits; the table in constraints.cpp has the advice for each.
///
/// Casts first the hand-written recipes in their order, then the families, then the sampled faces.
/// Applies the reviews in their order. With first-fit casting, each review is applied as soon as
/// the reviewed faces are cast. With `mode: spread`, all reviews are applied after the last face.
/// Stores each face's nearest head and nearest earlier face. The number of attempts is bounded. If
/// constraints cannot be met, the result has a shortfall; no exception is thrown.
///
/// \param on_face_joined  Called after each sampled face.
/// \throws InvalidInput if a family or a review names a face that does not exist.
CastingResult cast_crowd(const CastingOptions& casting, const FaceJudge& judge,
                         const FaceJoinedCallback& on_face_joined = {});

/// For each face of a crowd, beginning with index `first`, finds the nearest head and the nearest
/// earlier face, and stores both in the face's plan.
void find_nearest_neighbours(const FaceJudge& judge, CastingResult& cast, std::size_t first = 0);

}  // namespace crowdface
