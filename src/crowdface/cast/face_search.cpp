// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_search.h"

#include <algorithm>

namespace crowdface {

FaceSearch::FaceSearch(Draw draw, const FaceJudge& judge, const DiversityOptions& diversity,
                       int candidates, std::uint32_t first_attempt)
    : draw_(std::move(draw)),
      judge_(judge),
      diversity_(diversity),
      wanted_(static_cast<std::size_t>(candidates)),
      next_attempt_(first_attempt),
      last_attempt_(first_attempt + static_cast<std::uint32_t>(diversity.max_attempts)) {}

/// Draws until there are as many candidates as asked for, or no attempts left.
void FaceSearch::draw_candidates(const CrowdSoFar& crowd) {
  while (candidates_.size() < wanted_ && next_attempt_ < last_attempt_) {
    Candidate candidate;
    candidate.face = draw_(next_attempt_++);
    candidate.point = judge_.space().point(candidate.face.recipe);
    if (const auto reason = judge_.at_a_glance(candidate.face.recipe, candidate.point)) {
      rejections_.add(*reason);
      continue;
    }
    // Only one candidate: how far it is does not matter once it is far enough.
    const double limit = wanted_ == 1 ? diversity_.min_distance_mm : HUGE_VAL;
    const double least = diversity_.min_distance_mm;
    candidate.nearest_mm =
        crowd.index().nearest(candidate.point, limit, crowd.first_sampled(), crowd.size()).mm;
    if (candidate.nearest_mm < least ||
        crowd.index().nearest(candidate.point, least, 0, crowd.first_sampled()).face >= 0) {
      rejections_.add(Reason::kMinDistance);
      continue;
    }
    candidates_.push_back(std::move(candidate));
  }
  compared_ = crowd.size();
}

/// Faces have joined the crowd since the candidates were drawn.
void FaceSearch::compare_with_newer(const CrowdSoFar& crowd) {
  if (compared_ == crowd.size()) return;
  for (Candidate& candidate : candidates_) {
    const auto nearest =
        crowd.index().nearest(candidate.point, candidate.nearest_mm, compared_, crowd.size());
    candidate.nearest_mm = std::min(candidate.nearest_mm, nearest.mm);
  }
  const auto gone = std::erase_if(candidates_, [&](const Candidate& candidate) {
    return candidate.nearest_mm < diversity_.min_distance_mm;
  });
  rejections_.add(Reason::kMinDistance, gone);
  compared_ = crowd.size();
}

/// Of equally far ones the one drawn first.
void FaceSearch::farthest_first() {
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    return a.nearest_mm != b.nearest_mm ? a.nearest_mm > b.nearest_mm
                                        : a.face.notes.attempt < b.face.notes.attempt;
  });
}

void FaceSearch::judge_closely(Candidate& candidate) const {
  if (candidate.judged) return;
  candidate.broken = judge_.closely(candidate.face.recipe);
  candidate.judged = true;
}

void FaceSearch::prepare(const CrowdSoFar& crowd) {
  draw_candidates(crowd);
  farthest_first();
  if (!candidates_.empty()) judge_closely(candidates_.front());  // most likely the one
}

std::optional<FaceSearch::Found> FaceSearch::settle(const CrowdSoFar& crowd,
                                                    const Refuses& refuses) {
  for (;;) {
    compare_with_newer(crowd);
    draw_candidates(crowd);
    if (candidates_.empty()) return std::nullopt;
    farthest_first();
    for (Candidate& candidate : candidates_) {
      if (const auto why = refuses ? refuses(candidate.point) : std::nullopt) {
        rejections_.add(*why);
        continue;
      }
      judge_closely(candidate);
      if (candidate.broken) {
        rejections_.add(*candidate.broken);
        continue;
      }
      return Found{std::move(candidate.face), std::move(candidate.point)};
    }
    candidates_.clear();
  }
}

}  // namespace crowdface
