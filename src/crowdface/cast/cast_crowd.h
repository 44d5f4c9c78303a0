// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"

namespace crowdface {

/// Where casting had to stop.
struct Shortfall {
  std::uint64_t reached = 0;  ///< sampled faces that were found
  Rejections rejections;      ///< why the next one's candidates were thrown away
  int quota = -1;             ///< that the next one counts for, or −1
};

/// A crowd that was cast.
struct CrowdCast {
  std::vector<Recipe> crowd;             ///< hand-written recipes, then faces 1 … count
  std::vector<FaceSpace::Place> places;  ///< of each
  std::vector<int> quotas;               ///< which quota each sampled face counts for, or −1
  Rejections rejections;
  std::optional<Shortfall> shortfall;
};

/// Casts the crowd: hand-written recipes in their order, then the sampled faces, each judged before
/// it joins. Effort is bounded; what cannot be met ends in a shortfall, not in an exception.
/// \throws InvalidInput if a hand-written recipe's weights cannot be normalised.
CrowdCast cast_crowd(const Casting& casting, const FaceJudge& judge);

/// The nearest head and the nearest face before it, for each face of a crowd.
void find_nearest(const FaceJudge& judge, CrowdCast& cast);

}  // namespace crowdface
