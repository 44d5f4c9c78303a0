// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "crowdface/cast/constraints.h"
#include "crowdface/cast/crowd_so_far.h"
#include "crowdface/cast/face_judge.h"

namespace crowdface {

/// The search for one face: generates candidates, rejects candidates that violate a constraint, and
/// chooses the candidate farthest from the crowd (best-candidate sampling, Mitchell 1991; with one
/// candidate, the first that is far enough). The result depends only on the generated candidates
/// and on the crowd passed to `choose_face`. The crowd passed to `prepare` only affects the speed.
class FaceSearch {
 public:
  /// Generates candidate number `attempt`. Must be a pure function.
  using Generate = std::function<FacePlan(std::uint32_t attempt)>;
  /// An additional check of a candidate's point: returns why the point is rejected; nothing if it
  /// is accepted.
  using RejectionCheck = std::function<std::optional<Reason>(const FaceSpace::Point&)>;

  /// How undesirable a candidate is, from its landmarks; see FaceMeasurer.
  using Cost = std::function<double(const Positions& landmarks)>;

  FaceSearch(Generate generate, const FaceJudge& judge, const DiversityOptions& diversity,
             int candidates, std::uint32_t first_attempt = 0);

  /// Generates candidates in advance and compares them with the current crowd. Different searches
  /// may run in parallel.
  void prepare(const CrowdSoFar& crowd);

  struct Found {
    FacePlan face;
    FaceSpace::Point point;
    Positions landmarks = {};  ///< no rows if measurements have neither limits nor distributions
  };
  /// Returns the face chosen against the current crowd; nothing if all attempts are used up.
  /// \param cost  chooses the candidate with the least cost instead of the farthest; may be empty
  std::optional<Found> choose_face(const CrowdSoFar& crowd,
                                   const RejectionCheck& rejection_reason = {},
                                   const Cost& cost = {});

  const Rejections& rejections() const { return rejections_; }

 private:
  struct Candidate {
    FacePlan face;
    FaceSpace::Point point;
    Positions landmarks = {};
    /// distance to the nearest face, or an upper bound of this distance
    double nearest_mm = HUGE_VAL;
    bool is_exact = true;    ///< whether `nearest_mm` is the distance, not only a bound
    bool is_judged = false;  ///< whether `check_skin` was called
    std::optional<Reason> violated_constraint = std::nullopt;
  };

  bool needs_candidates() const;
  bool meets_limits(Candidate& candidate);
  void find_candidates(const CrowdSoFar& crowd);
  bool is_far_from_crowd(Candidate& candidate, const CrowdSoFar& crowd) const;
  void compare_with_added_faces(const CrowdSoFar& crowd);
  Candidate& farthest_candidate(const CrowdSoFar& crowd);
  Candidate& cheapest_candidate(const Cost& cost);
  void judge_skin(Candidate& candidate) const;

  Generate generate_;
  const FaceJudge& judge_;
  const DiversityOptions& diversity_;
  std::size_t wanted_count_;
  std::uint32_t first_attempt_, next_attempt_, last_attempt_, usual_attempt_;
  Index compared_count_ = 0;  ///< number of faces that the candidates were compared with
  std::vector<Candidate> candidates_;
  Rejections rejections_;
};

}  // namespace crowdface
