// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/cast_crowd.h"

#include <algorithm>
#include <memory>

#include "crowdface/cast/apply_review.h"
#include "crowdface/cast/face_changes.h"
#include "crowdface/cast/face_search.h"
#include "crowdface/cast/population.h"
#include "crowdface/cast/shares.h"
#include "crowdface/cast/spread.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

/// Casts the sampled faces `from` … `to`. Each face must be far enough from all earlier faces.
///
/// \param diversity  options whose `min_distance_mm` applies to all these faces.
void cast_first_fit(const CastingOptions& casting, const DiversityOptions& diversity,
                    const FaceJudge& judge, const std::vector<FaceDistribution>& distributions,
                    const FamilySeparation& family_separation, std::uint64_t from, std::uint64_t to,
                    CrowdSoFar& crowd, PopulationBalance& population,
                    const FaceJoinedCallback& on_face_joined, CastingResult& result) {
  const AvoidedFaces changes(result, diversity.min_distance_mm);
  FaceSearch::Cost cost;
  if (!casting.trait_targets.empty()) {
    cost = [&](const Positions& landmarks) { return population.cost(landmarks); };
  }
  for (std::uint64_t first = from; first <= to; first += kFacesCastInParallel) {
    throw_if_interrupted();
    const std::uint64_t last = std::min(to, first + kFacesCastInParallel - 1);
    std::vector<FaceSearch> searches;
    for (std::uint64_t index = first; index <= last; ++index) {
      const FaceDistribution& kind =
          distributions[static_cast<std::size_t>(result.group_indices[index - 1] + 1)];
      searches.emplace_back(
          [&casting, &kind, index](std::uint32_t attempt) {
            return random_face(casting, index, attempt, kind);
          },
          judge, diversity, DiversityOptions::candidate_count(index));
    }
    parallel_for_each(searches.size(), [&](std::size_t i) { searches[i].prepare(crowd); });
    for (std::uint64_t index = first; index <= last; ++index) {
      FaceSearch& search = searches[index - first];
      auto found = search.choose_face(
          crowd,
          [&](const FaceSpace::Point& point) {
            const auto why = family_separation.rejection_reason(point);
            return why ? why : changes.rejection_reason(point);
          },
          cost);
      result.rejections.add(search.rejections());
      if (!found) {
        result.shortfall =
            Shortfall{index - 1, search.rejections(), result.group_indices[index - 1]};
        return;
      }
      if (cost) population.add(found->landmarks);
      crowd.add(std::move(found->face), std::move(found->point));
      if (on_face_joined) on_face_joined(search.rejections());
    }
  }
}

/// Casts the sampled faces `from` … `to`. Different faces may have different minimum distances, see
/// DiversityOptions::min_distance_mm_up_to_face.
void cast_first_fit(const CastingOptions& casting, const FaceJudge& judge,
                    const std::vector<FaceDistribution>& distributions,
                    const FamilySeparation& family_separation, std::uint64_t from, std::uint64_t to,
                    CrowdSoFar& crowd, PopulationBalance& population,
                    const FaceJoinedCallback& on_face_joined, CastingResult& result) {
  const auto& distances = casting.diversity.min_distance_mm_up_to_face;
  while (from <= to && !result.shortfall) {
    const auto same = distances.lower_bound(from);
    const std::uint64_t last = same == distances.end() ? to : std::min(to, same->first);
    cast_first_fit(casting, casting.diversity.options_of_face(from), judge, distributions,
                   family_separation, from, last, crowd, population, on_face_joined, result);
    from = last + 1;
  }
}

/// Completes a hand-written recipe with random values. Draws these values again until the face
/// meets the recipe's limits on measurements.
///
/// \return  Nothing if no attempt meets the limits.
std::optional<FacePlan> completed_within_limits(const CastingOptions& casting,
                                                const ManualRecipe& hand, const FaceJudge& judge) {
  const auto attempts =
      kAttemptFactorWithTraits * static_cast<std::uint32_t>(casting.diversity.max_attempts);
  for (std::uint32_t attempt = 0; attempt < attempts; ++attempt) {
    FacePlan face = completed_face_plan(casting, hand, attempt);
    const TraitRules* rules = hand.traits.empty() ? nullptr : judge.trait_rules();
    if (rules == nullptr) return face;
    if (rules->check(face, rules->measurer().landmarks(face.recipe))) continue;
    if (!judge.check_traits(face)) return face;
  }
  return std::nullopt;
}

/// Returns one value for each review: the number of sampled faces that are cast before the review
/// is applied.
std::vector<std::uint64_t> faces_before_reviews(const CastingOptions& casting) {
  std::vector<std::uint64_t> counts;
  std::uint64_t so_far = 0;
  const bool at_once = casting.diversity.mode == DiversityOptions::Mode::kSpread;
  for (const Review& review : casting.reviews) {
    const std::uint64_t own =
        at_once ? casting.count : review.reviewed_face_count.value_or(casting.count);
    so_far = std::max(so_far, std::min(own, casting.count));
    counts.push_back(so_far);
  }
  return counts;
}

FamilySeparation separation_of(const CastingResult& cast) {
  FamilySeparation separation;
  for (const FamilyPlan& family : cast.families) {
    separation.add(family.name, {cast.points.begin() + family.members_begin,
                                 cast.points.begin() + family.members_end});
  }
  return separation;
}

void take_crowd(const FaceJudge& judge, CrowdSoFar& crowd, CastingResult& result) {
  const std::size_t known = result.crowd.size();
  result.crowd = crowd.take_faces();
  result.points = crowd.take_points();
  if (!result.shortfall) find_nearest_neighbours(judge, result, known);
}

/// Casts the sampled faces `from` … `to`, after a review has been applied.
void cast_after_review(const CastingOptions& casting, const FaceJudge& judge,
                       const std::vector<FaceDistribution>& distributions, std::uint64_t from,
                       std::uint64_t to, PopulationBalance& population,
                       const FaceJoinedCallback& on_face_joined, CastingResult& result) {
  auto crowd = std::make_unique<CrowdSoFar>(judge.space().dimensions());
  const std::size_t others = result.crowd.size() - (from - 1);
  for (std::size_t i = 0; i < result.crowd.size(); ++i) {
    if (i == others) crowd->begin_sampled_faces();
    crowd->add(result.crowd[i], result.points[i]);
  }
  if (others == result.crowd.size()) crowd->begin_sampled_faces();
  cast_first_fit(casting, judge, distributions, separation_of(result), from, to, *crowd, population,
                 on_face_joined, result);
  take_crowd(judge, *crowd, result);
}

}  // namespace

CastingResult cast_crowd(const CastingOptions& casting, const FaceJudge& judge,
                         const FaceJoinedCallback& on_face_joined) {
  CastingResult result;
  auto so_far = std::make_unique<CrowdSoFar>(judge.space().dimensions());
  CrowdSoFar& crowd = *so_far;
  for (const ManualRecipe& hand : casting.recipes) {
    std::optional<FacePlan> face = completed_within_limits(casting, hand, judge);
    if (!face) {
      RejectionCounts rejections;
      rejections.add(RejectionReason::kTraits);
      result.shortfall = Shortfall{0, rejections, -1, {}, {}, hand.id};
      return result;
    }
    FaceSpace::Point point = judge.space().point(face->recipe);
    crowd.add(*std::move(face), std::move(point));
  }
  FamilySeparation family_separation;
  const UnrelatedFaces unrelated(casting, judge.space());
  CastingOptions of_families = casting;
  of_families.diversity = casting.diversity.options_of_face(0);
  for (const FamilyOptions& family : casting.families) {
    RejectionCounts rejections;
    auto cast =
        cast_family(of_families, family, judge, unrelated, crowd, family_separation, rejections);
    result.rejections.add(rejections);
    if (!cast) {
      result.shortfall = Shortfall{0, rejections, -1, family.name};
      return result;
    }
    result.families.push_back(std::move(*cast));
  }
  crowd.begin_sampled_faces();
  result.group_indices = schedule_groups(casting.groups, casting.count);
  const std::vector<FaceDistribution> distributions = face_distributions(casting);
  const std::vector<std::uint64_t> before = faces_before_reviews(casting);
  PopulationBalance population(casting.trait_targets);
  std::uint64_t sampled = before.empty() ? casting.count : before.front();
  if (casting.diversity.mode == DiversityOptions::Mode::kSpread) {
    cast_spread(casting, judge, distributions, family_separation, crowd, on_face_joined, result);
  } else {
    cast_first_fit(casting, judge, distributions, family_separation, 1, sampled, crowd, population,
                   on_face_joined, result);
  }
  take_crowd(judge, crowd, result);
  so_far.reset();  // free the search index, which takes as much memory as the points
  const auto grow_to = [&](std::uint64_t count) {
    if (result.shortfall || count <= sampled) return;
    cast_after_review(casting, judge, distributions, sampled + 1, count, population, on_face_joined,
                      result);
    sampled = count;
  };
  for (std::size_t r = 0; r < casting.reviews.size(); ++r) {
    grow_to(before[r]);
    if (!result.shortfall) apply_review(casting, judge, r, result);
  }
  grow_to(casting.count);
  if (!result.shortfall) apply_changes_of_config(casting, judge, result);
  return result;
}

void find_nearest_neighbours(const FaceJudge& judge, CastingResult& cast, std::size_t first) {
  NearestFaceSearch index(judge.space().dimensions());
  for (const FaceSpace::Point& point : cast.points) index.add(point);
  parallel_for_each(cast.points.size() - first, [&](std::size_t after_first) {
    const auto i = static_cast<Index>(first + after_first);
    const FaceSpace::Point& point = cast.points[first + after_first];
    const auto [head, head_distance_mm] = judge.nearest_head(point);
    NearestNeighbours nearest{head, head_distance_mm, std::nullopt, 0};
    if (i > 0) {
      const NearestFaceSearch::NearestFace face = index.nearest(point, HUGE_VAL, 0, i);
      nearest.earlier_face = cast.crowd[static_cast<std::size_t>(face.face)].id;
      nearest.earlier_face_distance_mm = face.distance_mm;
    }
    cast.crowd[static_cast<std::size_t>(i)].notes.nearest = nearest;
  });
}

}  // namespace crowdface
