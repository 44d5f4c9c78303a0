// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "crowdface/cast/constraints.h"
#include "crowdface/cast/crowd_so_far.h"
#include "crowdface/cast/face_judge.h"

namespace crowdface {

/// The search for one face: draws candidates, throws away those that will not do, and settles on
/// the one farthest from the crowd (Mitchell 1991, best-candidate sampling; with one candidate:
/// the first that is far enough). What it finds depends on the crowd that it is settled against and
/// on its own draws alone, not on when it was prepared.
class FaceSearch {
 public:
  /// Draws attempt number n. Must be a pure function.
  using Draw = std::function<CastFace(std::uint32_t attempt)>;
  /// One more reason to refuse a place, given the crowd; nothing if there is none.
  using Refuses = std::function<std::optional<Reason>(const FaceSpace::Point&)>;

  FaceSearch(Draw draw, const FaceJudge& judge, const DiversityOptions& diversity, int candidates,
             std::uint32_t first_attempt = 0);

  /// Draws candidates ahead, against the crowd as it is now. May run beside others.
  void prepare(const CrowdSoFar& crowd);

  struct Found {
    CastFace face;
    FaceSpace::Point point;
  };
  /// The face, against the crowd as it is now; nothing once all attempts are used up.
  std::optional<Found> settle(const CrowdSoFar& crowd, const Refuses& refuses = {});

  const Rejections& rejections() const { return rejections_; }

 private:
  struct Candidate {
    CastFace face;
    FaceSpace::Point point;
    double nearest_mm = HUGE_VAL;  ///< from the nearest face; if not known, at most
    bool known = true;
    bool judged = false;  ///< closely
    std::optional<Reason> broken = std::nullopt;
  };

  void draw_candidates(const CrowdSoFar& crowd);
  bool meet_crowd(Candidate& candidate, const CrowdSoFar& crowd) const;
  void compare_with_newer(const CrowdSoFar& crowd);
  Candidate& farthest(const CrowdSoFar& crowd);
  void judge_closely(Candidate& candidate) const;

  Draw draw_;
  const FaceJudge& judge_;
  const DiversityOptions& diversity_;
  std::size_t wanted_;
  std::uint32_t next_attempt_, last_attempt_;
  Index compared_ = 0;  ///< faces of the crowd that the candidates were compared with
  std::vector<Candidate> candidates_;
  Rejections rejections_;
};

}  // namespace crowdface
