// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/cast/casting_result.h"
#include "crowdface/cast/crowd_so_far.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"
#include "crowdface/cast/shares.h"

namespace crowdface {

/// A pool of candidates. Each candidate satisfies all constraints except the distances within the
/// crowd.
struct CandidatePool {
  std::vector<FacePlan> faces;
  std::vector<FaceSpace::Point> points;
  std::vector<int> kinds;  ///< group of each candidate, or −1
  Rejections rejections;
};

/// Generates a pool of candidates for `times` crowds of `count` faces. Groups have the same
/// proportions as in the crowd.
///
/// \param kinds  Parameters of faces without group, then of each group.
CandidatePool sample_pool(const CastingOptions& casting, const FaceJudge& judge,
                          const std::vector<FaceKind>& kinds, std::uint64_t count,
                          std::uint64_t times = 1);

/// Picks candidates from a pool, one after the other: always the candidate farthest from the picked
/// candidates and from the initial crowd (greedy farthest point). In any other set of as many
/// candidates, the closest pair is at most twice as far apart (Gonzalez 1985; Ravi, Rosenkrantz &
/// Tayi 1994), provided that the distance is a metric (all extrapolation factors are 1), there are
/// no groups, and the initial crowd is empty.
class FarthestPoints {
 public:
  FarthestPoints(const CandidatePool& pool, const CrowdSoFar& crowd);

  struct Pick {
    Index candidate = -1;  ///< index of the candidate; −1: none left
    /// distance to the nearest picked or initial face; infinite if there is none
    double distance_mm = 0;
  };
  /// Returns the farthest candidate of a group (−1: of no group). Does not pick it.
  Pick farthest(int kind) const;
  /// Picks a candidate, and updates the distances of all other candidates.
  void pick(Index candidate);
  /// Removes a candidate without picking it.
  void drop(Index candidate) { dropped_[static_cast<std::size_t>(candidate)] = true; }

 private:
  const CandidatePool& pool_;
  std::vector<double> squared_distances_;  ///< squared distance from the nearest picked face
  std::vector<bool> dropped_;
};

/// Casts faces 1 … count: picks them from a pool by FarthestPoints.
void cast_spread(const CastingOptions& casting, const FaceJudge& judge,
                 const std::vector<FaceKind>& kinds, const FamilySeparation& family_separation,
                 CrowdSoFar& crowd, const FaceJoined& joined, CastingResult& result);

}  // namespace crowdface
