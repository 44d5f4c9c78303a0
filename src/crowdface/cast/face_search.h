// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "crowdface/cast/constraints.h"
#include "crowdface/cast/crowd_so_far.h"
#include "crowdface/cast/face_judge.h"

namespace crowdface {

/// The search for one face. Generates candidates, rejects candidates that violate a constraint, and
/// chooses the candidate farthest from the crowd (best-candidate sampling, Mitchell 1991). If only
/// one candidate is wanted, chooses the first candidate that is far enough. The result depends only
/// on the generated candidates and on the crowd passed to `choose_face`. The crowd passed to
/// `prepare` affects only the speed.
class FaceSearch {
 public:
  /// Generates candidate number `attempt`. The result must depend only on `attempt` (a pure
  /// function).
  using GenerateCandidate = std::function<FacePlan(std::uint32_t attempt)>;
  /// An additional check of a candidate, given the candidate's point in the face space. Returns why
  /// the candidate is rejected; nothing if the candidate is accepted.
  using RejectionCheck = std::function<std::optional<RejectionReason>(const FaceSpace::Point&)>;

  /// Returns how undesirable a candidate is, given the candidate's landmarks (see FaceMeasurer).
  /// Costs serve only to compare candidates.
  using Cost = std::function<double(const Positions& landmarks)>;

  /// \param wanted_candidate_count  Number of acceptable candidates in a round, among which the
  ///                                search chooses the face.
  FaceSearch(GenerateCandidate generate_candidate, const FaceJudge& judge,
             const DiversityOptions& diversity, int wanted_candidate_count,
             std::uint32_t first_attempt = 0);

  /// Generates candidates in advance and compares them with the current crowd. Different searches
  /// may run in parallel.
  void prepare(const CrowdSoFar& crowd);

  /// The face that the search chose.
  struct FoundFace {
    FacePlan face;
    FaceSpace::Point point;
    /// positions of the face's landmarks; no rows if the crowd has neither limits nor distributions
    /// of measurements
    Positions landmarks = {};
  };
  /// Returns the candidate that is farthest from the sampled faces of the current crowd and passes
  /// all checks; nothing if no attempts are left.
  ///
  /// \param cost  If given, returns the candidate with the smallest cost instead of the farthest
  ///              candidate.
  std::optional<FoundFace> choose_face(const CrowdSoFar& crowd,
                                       const RejectionCheck& rejection_reason = {},
                                       const Cost& cost = {});

  const RejectionCounts& rejections() const { return rejections_; }

 private:
  /// A generated candidate, and the results of its checks so far.
  struct Candidate {
    FacePlan face;
    FaceSpace::Point point = {};
    Positions landmarks = {};
    /// distance to the nearest sampled face of the crowd, or an upper bound of this distance
    double distance_to_crowd_mm = HUGE_VAL;
    /// whether `distance_to_crowd_mm` is the exact distance, not an upper bound
    bool is_distance_exact = true;
    bool is_skin_judged = false;  ///< whether `judge_skin` has judged the candidate
    /// the constraint that `judge_skin` found violated; empty if there is none
    std::optional<RejectionReason> violated_constraint = std::nullopt;
  };

  /// Returns whether a round needs another candidate. A round also counts the candidates that are
  /// too near to the crowd, so that a nearly full crowd does not need many more candidates. A face
  /// with limits on measurements may need many more attempts than other faces. So after the usual
  /// number of attempts, one acceptable candidate is enough.
  ///
  /// \param unchecked_count  number of generated candidates that are not checked yet
  /// \param too_near_count   number of candidates of this round that were too near to the crowd
  bool needs_candidates(std::size_t unchecked_count, std::size_t too_near_count) const;
  /// Measures a candidate and checks the limits on measurements, if the config has any.
  bool meets_limits(Candidate& candidate);
  /// Generates a round of candidates, and further rounds until a candidate passes all checks or no
  /// attempts are left.
  void find_candidates(const CrowdSoFar& crowd);
  /// Generates as many candidates as a round still needs, and keeps those that pass all checks.
  /// Computes the points of the candidates in one call, which is faster than separate calls.
  ///
  /// \param too_near_count  number of candidates of this round that were too near to the crowd;
  ///                        increased by the new ones
  void add_candidates(const CrowdSoFar& crowd, std::size_t& too_near_count);
  /// Returns whether a candidate is far enough from every face of the crowd. If several candidates
  /// are wanted, also sets `candidate.distance_to_crowd_mm`, the distance to the nearest sampled
  /// face of the crowd. If the search has a candidate that is farther from the sampled faces, sets
  /// only an upper bound of this distance, because the bound is faster to compute and usually
  /// sufficient.
  bool is_far_from_crowd(Candidate& candidate, const CrowdSoFar& crowd) const;
  /// Compares the candidates with the faces that have joined the crowd since the last comparison.
  void compare_with_added_faces(const CrowdSoFar& crowd);
  /// Returns the candidate farthest from the crowd's sampled faces; of equally far candidates, the
  /// earliest.
  Candidate& farthest_candidate(const CrowdSoFar& crowd);
  /// Returns the candidate with the smallest cost; of candidates with equal cost, the earliest.
  Candidate& cheapest_candidate(const Cost& cost);
  /// Checks a candidate's exact measurements and skin, unless they have been checked already.
  void judge_skin(Candidate& candidate) const;

  GenerateCandidate generate_candidate_;
  const FaceJudge& judge_;
  const DiversityOptions& diversity_;
  /// number of acceptable candidates that a round should find
  std::size_t wanted_candidate_count_;
  /// number of the first candidate of this search, and of the next candidate to generate
  std::uint32_t first_attempt_, next_attempt_;
  /// Number of the attempt after the last allowed attempt. Each candidate that violates limits on
  /// measurements raises `attempts_end_` by one, up to a bound.
  std::uint32_t attempts_end_;
  std::uint32_t initial_attempts_end_;  ///< initial value of `attempts_end_`
  /// number of faces of the crowd with which the candidates have been compared
  Index compared_face_count_ = 0;
  std::vector<Candidate> candidates_;
  RejectionCounts rejections_;
};

}  // namespace crowdface
