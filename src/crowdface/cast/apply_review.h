// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/cast/casting_result.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"

namespace crowdface {

/// Stores a review's notes, and redraws the faces that the review rejects. Each redrawn face keeps
/// the minimum distance from all other faces. Then applies the changes that the review requests.
/// All other faces stay as they are.
///
/// - A redrawn face keeps the changes of earlier reviews.
/// - A review may reject a face and lock some of the face's bands. If an earlier FaceChange has
///   redrawn this face (ChangedFace::is_other_person), the rejection has the same effect as one
///   more FaceChange that locks these bands.
///
/// \param review_index  index of the review in `crowd_options.reviews`.
/// \throws InvalidInput if the review names a face that is not in the crowd.
void apply_review(const CastingOptions& crowd_options, const FaceJudge& judge,
                  std::size_t review_index, CastingResult& cast);

}  // namespace crowdface
