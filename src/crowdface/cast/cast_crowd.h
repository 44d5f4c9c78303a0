// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"
#include "crowdface/cast/families.h"
#include "crowdface/cast/quotas.h"

namespace crowdface {

/// Where casting had to stop.
struct Shortfall {
  std::uint64_t reached = 0;  ///< sampled faces that were found
  Rejections rejections;      ///< why the next one's candidates were thrown away
  int quota = -1;             ///< that the next one counts for, or −1
  std::string family = {};    ///< that could not be cast, if it was one
  std::string reviewed = {};  ///< the id of a face that could not be drawn anew, if it was one
};

/// A crowd that was cast.
struct CrowdCast {
  std::vector<Recipe> crowd;             ///< recipes, then families, then faces 1 … count
  std::vector<FaceSpace::Place> places;  ///< of each
  std::vector<int> quotas;               ///< which quota each sampled face counts for, or −1
  std::vector<FamilyCast> families;
  Rejections rejections;
  std::optional<Shortfall> shortfall;
};

/// Casts the crowd: hand-written recipes in their order, then families, then the sampled faces, each
/// judged before it joins; then the reviews, one after the other. Each face gets its nearest head
/// and the nearest face that was there before it. Effort is bounded; what cannot be met ends in a
/// shortfall, not in an exception.
/// \param joined  called after each sampled face, if given.
/// \throws InvalidInput if a hand-written recipe's weights cannot be normalised.
CrowdCast cast_crowd(const Casting& casting, const FaceJudge& judge,
                     const std::function<void()>& joined = {});

/// The targets that faces of no quota may have, then those of each.
TargetsOfQuota targets_by_quota(const Casting& casting);

/// The nearest head and the nearest face before it, for each face of a crowd.
void find_nearest(const FaceJudge& judge, CrowdCast& cast);

/// Draws the faces anew that a review rejects, against all others, and notes what it says. All other
/// faces stay as they are. \throws InvalidInput if it names a face that is not in the crowd.
void apply_review(const Casting& casting, const FaceJudge& judge, const Review& review,
                  CrowdCast& cast);

}  // namespace crowdface
