// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_search.h"

#include <algorithm>
#include <cmath>

namespace crowdface {

FaceSearch::FaceSearch(GenerateCandidate generate_candidate, const FaceJudge& judge,
                       const DiversityOptions& diversity, int wanted_candidate_count,
                       std::uint32_t first_attempt)
    : generate_candidate_(std::move(generate_candidate)),
      judge_(judge),
      diversity_(diversity),
      wanted_candidate_count_(static_cast<std::size_t>(wanted_candidate_count)),
      first_attempt_(first_attempt),
      next_attempt_(first_attempt),
      attempts_end_(first_attempt + static_cast<std::uint32_t>(diversity.max_attempts)),
      initial_attempts_end_(attempts_end_) {}

bool FaceSearch::is_far_from_crowd(Candidate& candidate, const CrowdSoFar& crowd) const {
  const double least = diversity_.min_distance_mm;
  if (least > 0 && crowd.nearest_search().nearest(candidate.point, least).face >= 0) return false;
  if (wanted_candidate_count_ == 1) return true;
  double farthest = 0;
  for (const Candidate& other : candidates_) {
    if (other.is_distance_exact) farthest = std::max(farthest, other.distance_to_crowd_mm);
  }
  candidate.distance_to_crowd_mm =
      crowd.nearest_search()
          .nearest(candidate.point, HUGE_VAL, crowd.first_sampled_index(), crowd.size(), farthest)
          .distance_mm;
  candidate.is_distance_exact = candidate.distance_to_crowd_mm >= farthest;
  return true;
}

bool FaceSearch::needs_candidates(std::size_t unchecked_count, std::size_t too_near_count) const {
  const std::size_t count = candidates_.size() + unchecked_count;
  if (count + too_near_count >= wanted_candidate_count_ || next_attempt_ >= attempts_end_)
    return false;
  return count == 0 || next_attempt_ < initial_attempts_end_;
}

/// If the config limits measurements, measures a candidate and checks the limits. Each candidate
/// that violates these limits raises the allowed number of attempts by one, up to a multiple of the
/// usual number.
bool FaceSearch::meets_limits(Candidate& candidate) {
  candidate.landmarks = judge_.landmarks(candidate.face.recipe);
  const auto reason = judge_.check_traits(candidate.face, candidate.landmarks);
  if (!reason) return true;
  rejections_.add(*reason);
  const auto usual = static_cast<std::uint32_t>(diversity_.max_attempts);
  if (attempts_end_ - initial_attempts_end_ < (kAttemptFactorWithTraits - 1) * usual)
    ++attempts_end_;
  return false;
}

void FaceSearch::find_candidates(const CrowdSoFar& crowd) {
  compared_face_count_ = crowd.size();
  while (candidates_.empty() && next_attempt_ < attempts_end_) {
    std::size_t too_near_count = 0;
    while (needs_candidates(0, too_near_count)) add_candidates(crowd, too_near_count);
  }
}

void FaceSearch::add_candidates(const CrowdSoFar& crowd, std::size_t& too_near_count) {
  std::vector<Candidate> unchecked;
  std::vector<const Recipe*> recipes;
  while (needs_candidates(unchecked.size(), too_near_count)) {
    Candidate candidate{generate_candidate_(next_attempt_++)};
    if (meets_limits(candidate)) unchecked.push_back(std::move(candidate));
  }
  for (const Candidate& candidate : unchecked) recipes.push_back(&candidate.face.recipe);
  std::vector<FaceSpace::Point> points = judge_.space().points(recipes);
  for (std::size_t i = 0; i < unchecked.size(); ++i) {
    Candidate& candidate = unchecked[i];
    candidate.point = std::move(points[i]);
    if (const auto reason = judge_.check_candidate(candidate.face.recipe, candidate.point,
                                                   candidate.face.notes.attempt - first_attempt_)) {
      rejections_.add(*reason);
    } else if (!is_far_from_crowd(candidate, crowd)) {
      rejections_.add(RejectionReason::kMinDistance);
      ++too_near_count;
    } else {
      candidates_.push_back(std::move(candidate));
    }
  }
}

void FaceSearch::compare_with_added_faces(const CrowdSoFar& crowd) {
  if (compared_face_count_ == crowd.size()) return;
  for (Candidate& candidate : candidates_) {
    const auto nearest = crowd.nearest_search().nearest(
        candidate.point, candidate.distance_to_crowd_mm, compared_face_count_, crowd.size());
    candidate.distance_to_crowd_mm = std::min(candidate.distance_to_crowd_mm, nearest.distance_mm);
  }
  const auto gone = std::erase_if(candidates_, [&](const Candidate& candidate) {
    return candidate.distance_to_crowd_mm < diversity_.min_distance_mm;
  });
  rejections_.add(RejectionReason::kMinDistance, gone);
  compared_face_count_ = crowd.size();
}

FaceSearch::Candidate& FaceSearch::farthest_candidate(const CrowdSoFar& crowd) {
  for (;;) {
    Candidate& first = *std::min_element(candidates_.begin(), candidates_.end(),
                                         [](const Candidate& a, const Candidate& b) {
                                           if (a.distance_to_crowd_mm != b.distance_to_crowd_mm)
                                             return a.distance_to_crowd_mm > b.distance_to_crowd_mm;
                                           if (a.is_distance_exact != b.is_distance_exact)
                                             return b.is_distance_exact;
                                           return a.face.notes.attempt < b.face.notes.attempt;
                                         });
    if (first.is_distance_exact) return first;
    const auto nearest = crowd.nearest_search().nearest(first.point, first.distance_to_crowd_mm,
                                                        crowd.first_sampled_index(), crowd.size());
    first.distance_to_crowd_mm = std::min(first.distance_to_crowd_mm, nearest.distance_mm);
    first.is_distance_exact = true;
  }
}

FaceSearch::Candidate& FaceSearch::cheapest_candidate(const Cost& cost) {
  std::vector<double> costs;
  for (const Candidate& candidate : candidates_) costs.push_back(cost(candidate.landmarks));
  return candidates_[static_cast<std::size_t>(std::ranges::min_element(costs) - costs.begin())];
}

void FaceSearch::judge_skin(Candidate& candidate) const {
  if (candidate.is_skin_judged) return;
  candidate.violated_constraint = judge_.check_traits(candidate.face);
  if (!candidate.violated_constraint)
    candidate.violated_constraint = judge_.check_skin(candidate.face.recipe);
  candidate.is_skin_judged = true;
}

void FaceSearch::prepare(const CrowdSoFar& crowd) {
  find_candidates(crowd);
  // Judge the candidate that will most likely be chosen.
  if (!candidates_.empty()) judge_skin(farthest_candidate(crowd));
}

std::optional<FaceSearch::FoundFace> FaceSearch::choose_face(const CrowdSoFar& crowd,
                                                             const RejectionCheck& rejection_reason,
                                                             const Cost& cost) {
  for (;;) {
    compare_with_added_faces(crowd);
    find_candidates(crowd);
    if (candidates_.empty()) return std::nullopt;
    // Take the first candidate that passes all checks. With `cost`, check the candidate with the
    // smallest cost first; otherwise the candidate farthest from the crowd. If no candidate passes,
    // generate more candidates.
    while (!candidates_.empty()) {
      Candidate& candidate = cost ? cheapest_candidate(cost) : farthest_candidate(crowd);
      auto why = rejection_reason ? rejection_reason(candidate.point) : std::nullopt;
      if (!why) {
        judge_skin(candidate);
        why = candidate.violated_constraint;
      }
      if (!why) {
        return FoundFace{std::move(candidate.face), std::move(candidate.point),
                         std::move(candidate.landmarks)};
      }
      rejections_.add(*why);
      candidates_.erase(candidates_.begin() + (&candidate - candidates_.data()));
    }
  }
}

}  // namespace crowdface
