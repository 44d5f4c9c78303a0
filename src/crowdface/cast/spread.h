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

/// A pool of candidates. Each candidate has passed FaceJudge::check_candidate and the limits on
/// approximate measurements. The skin, the exact measurements and the distances from other faces
/// are checked later.
struct CandidatePool {
  std::vector<FacePlan> faces;
  std::vector<FaceSpace::Point> points;
  std::vector<int> group_indices;  ///< for each candidate: index of its group, or −1
  RejectionCounts rejections;      ///< candidates that were rejected and are not in the pool
};

/// Generates a pool of at most `count` · `pool_size_factor` candidates. Groups have the same
/// proportions in the pool as in the crowd.
///
/// \param distributions  Distribution of the faces without a group, then of each group's faces.
CandidatePool sample_pool(const CastingOptions& casting, const FaceJudge& judge,
                          const std::vector<FaceDistribution>& distributions, std::uint64_t count,
                          std::uint64_t pool_size_factor = 1);

/// Picks candidates from a pool, one after the other. Each pick is the candidate farthest from the
/// initial crowd and from the candidates picked before (greedy farthest point). The smallest
/// distance between two picks is at least half of the optimum, which is the largest value that any
/// equally large set of candidates can reach (Gonzalez 1985; Ravi, Rosenkrantz & Tayi 1994). This
/// holds if the distance is a metric (all extrapolation factors are 1), there are no groups, and
/// the initial crowd is empty.
class FarthestPoints {
 public:
  FarthestPoints(const CandidatePool& pool, const CrowdSoFar& crowd);

  /// A candidate of the pool, and its distance from the nearest face.
  struct Pick {
    Index candidate = -1;  ///< index of the candidate; −1: no candidate is left
    /// distance to the nearest picked or initial face; infinite if there is no such face
    double distance_mm = 0;
  };
  /// Of the candidates of a group, returns the candidate farthest from all picked and initial
  /// faces. Does not pick this candidate.
  ///
  /// \param group_index  −1: the candidates without a group.
  Pick farthest(int group_index) const;
  /// Picks a candidate, and updates the distances of all other candidates.
  void pick(Index candidate);
  /// Removes a candidate, so that it is never picked.
  void remove(Index candidate) { removed_[static_cast<std::size_t>(candidate)] = true; }

 private:
  const CandidatePool& pool_;
  /// for each candidate: the squared distance from the nearest picked or initial face
  std::vector<double> squared_distances_;
  std::vector<bool> removed_;  ///< for each candidate: whether it was removed
};

/// Casts all sampled faces in spread mode: generates a pool of candidates, and picks the faces by
/// FarthestPoints.
void cast_spread(const CastingOptions& casting, const FaceJudge& judge,
                 const std::vector<FaceDistribution>& distributions,
                 const FamilySeparation& family_separation, CrowdSoFar& crowd,
                 const FaceJoinedCallback& on_face_joined, CastingResult& result);

}  // namespace crowdface
