// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/cast/crowd_cast.h"
#include "crowdface/cast/crowd_so_far.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"
#include "crowdface/cast/shares.h"

namespace crowdface {

/// Candidates of a pool, each of which will do by itself.
struct CandidatePool {
  std::vector<CastFace> faces;
  std::vector<FaceSpace::Point> points;
  std::vector<int> kinds;  ///< group of each, or −1
  Rejections rejections;
};

/// Draws a pool of `times` crowds of `count` faces. Groups are met by it as by a crowd.
/// \param kinds  of faces of no group, then of those of each.
CandidatePool draw_pool(const Casting& casting, const FaceJudge& judge,
                        const std::vector<FaceKind>& kinds, std::uint64_t count,
                        std::uint64_t times = 1);

/// Picks one of a pool's candidates after the other, each the one that is farthest from those
/// picked before and from the crowd it starts with (greedy farthest point). Whatever is picked, no
/// set of as many candidates has a closest pair more than twice as far apart (Gonzalez 1985; Ravi,
/// Rosenkrantz & Tayi 1994), as long as the distance is a metric: with every factor 1, no groups and
/// an empty crowd to start with.
class FarthestPoints {
 public:
  FarthestPoints(const CandidatePool& pool, const CrowdSoFar& crowd);

  struct Pick {
    Index candidate = -1;  ///< −1: none left
    double mm = 0;         ///< from what was there before; infinite for the first of all
  };
  /// The farthest of the candidates of this quota or group; it is not marked as picked yet.
  Pick farthest(int kind) const;
  /// Takes a candidate out, and measures how far all others are from it.
  void pick(Index candidate);
  /// Takes a candidate out, without it having joined.
  void drop(Index candidate) { gone_[static_cast<std::size_t>(candidate)] = true; }

 private:
  const CandidatePool& pool_;
  std::vector<double> squared_;  ///< from the nearest that was picked
  std::vector<bool> gone_;
};

/// Faces 1 … count as the most spread set out of a pool.
void cast_spread(const Casting& casting, const FaceJudge& judge, const std::vector<FaceKind>& kinds,
                 const Kinship& kinship, CrowdSoFar& crowd, const FaceJoined& joined,
                 CrowdCast& result);

}  // namespace crowdface
