// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/cast_crowd.h"

#include <algorithm>
#include <utility>

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
    if (!judge.check_traits(face, judge.landmarks(face.recipe)) && !judge.check_traits(face)) {
      return face;
    }
  }
  return std::nullopt;
}

FamilySeparation separation_of(const CastingResult& cast) {
  FamilySeparation separation;
  for (const FamilyPlan& family : cast.families) {
    separation.add(family.name, {cast.points.begin() + family.members_begin,
                                 cast.points.begin() + family.members_end});
  }
  return separation;
}

/// Casts one crowd: each step adds to the result. After a shortfall, all further steps do nothing.
class CrowdCaster {
 public:
  CrowdCaster(const CastingOptions& casting, const FaceJudge& judge,
              const FaceJoinedCallback& on_face_joined)
      : casting_(casting),
        judge_(judge),
        on_face_joined_(on_face_joined),
        distributions_(face_distributions(casting)),
        population_(casting.trait_targets) {}

  CastingResult cast() {
    CrowdSoFar unsampled(judge_.space().dimensions());
    cast_recipes(unsampled);
    cast_families(unsampled);
    if (result_.shortfall) return std::move(result_);
    take_crowd(unsampled);
    first_sampled_ = result_.crowd.size();
    result_.group_indices = schedule_groups(casting_.groups, casting_.count);
    for (std::size_t r = 0; r < casting_.reviews.size(); ++r) {
      cast_sampled_faces(count_before(casting_.reviews[r]));
      if (!result_.shortfall) apply_review(casting_, judge_, r, result_);
    }
    cast_sampled_faces(casting_.count);
    if (!result_.shortfall) apply_changes_of_config(casting_, judge_, result_);
    return std::move(result_);
  }

 private:
  void cast_recipes(CrowdSoFar& crowd) {
    for (const ManualRecipe& hand : casting_.recipes) {
      std::optional<FacePlan> face = completed_within_limits(casting_, hand, judge_);
      if (!face) {
        RejectionCounts rejections;
        rejections.add(RejectionReason::kTraits);
        result_.shortfall = Shortfall{0, rejections, -1, Shortfall::What::kManualRecipe, hand.id};
        return;
      }
      FaceSpace::Point point = judge_.space().point(face->recipe);
      crowd.add(*std::move(face), std::move(point));
    }
  }

  void cast_families(CrowdSoFar& crowd) {
    FamilySeparation family_separation;
    const UnrelatedFaces unrelated(casting_, judge_.space());
    CastingOptions of_families = casting_;
    of_families.diversity = casting_.diversity.options_of_face(0);
    for (const FamilyOptions& family : casting_.families) {
      if (result_.shortfall) return;
      RejectionCounts rejections;
      auto cast =
          cast_family(of_families, family, judge_, unrelated, crowd, family_separation, rejections);
      result_.rejections.add(rejections);
      if (cast) {
        result_.families.push_back(std::move(*cast));
      } else {
        result_.shortfall = Shortfall{0, rejections, -1, Shortfall::What::kFamily, family.name};
      }
    }
  }

  /// Returns the number of sampled faces that are cast before a review is applied.
  std::uint64_t count_before(const Review& review) const {
    const bool at_once = casting_.diversity.mode == DiversityOptions::Mode::kSpread;
    const std::uint64_t reviewed =
        at_once ? casting_.count : review.reviewed_face_count.value_or(casting_.count);
    return std::min(reviewed, casting_.count);
  }

  /// Casts the sampled faces after those that are cast already, up to face number `count`.
  void cast_sampled_faces(std::uint64_t count) {
    const std::uint64_t cast_count = result_.crowd.size() - first_sampled_;
    if (result_.shortfall || count <= cast_count) return;
    const FamilySeparation family_separation = separation_of(result_);
    CrowdSoFar crowd(judge_.space().dimensions());
    for (std::size_t i = 0; i < result_.crowd.size(); ++i) {
      if (i == first_sampled_) crowd.begin_sampled_faces();
      crowd.add(std::move(result_.crowd[i]), std::move(result_.points[i]));
    }
    if (cast_count == 0) crowd.begin_sampled_faces();
    if (casting_.diversity.mode == DiversityOptions::Mode::kSpread) {
      cast_spread(casting_, judge_, distributions_, family_separation, crowd, on_face_joined_,
                  result_);
    } else {
      cast_first_fit(family_separation, cast_count + 1, count, crowd);
    }
    take_crowd(crowd);
  }

  /// Casts the sampled faces `from` … `to`. Each face must be far enough from all earlier faces.
  void cast_first_fit(const FamilySeparation& family_separation, std::uint64_t from,
                      std::uint64_t to, CrowdSoFar& crowd) {
    const auto& distances = casting_.diversity.min_distance_mm_up_to_face;
    while (from <= to && !result_.shortfall) {
      std::uint64_t last = std::min(to, from + kFacesCastInParallel - 1);
      if (const auto same = distances.lower_bound(from); same != distances.end()) {
        last = std::min(last, same->first);
      }
      cast_block(casting_.diversity.options_of_face(from), family_separation, from, last, crowd);
      from = last + 1;
    }
  }

  /// Casts the sampled faces `from` … `to`. Generates the first candidates of these faces in
  /// parallel.
  ///
  /// \pre There are at most kFacesCastInParallel faces, and the same minimum distance from earlier
  /// faces applies to all of them.
  void cast_block(const DiversityOptions& diversity, const FamilySeparation& family_separation,
                  std::uint64_t from, std::uint64_t to, CrowdSoFar& crowd) {
    throw_if_interrupted();
    const AvoidedFaces changes(result_, diversity.min_distance_mm);
    FaceSearch::Cost cost;
    if (!casting_.trait_targets.empty()) {
      cost = [&](const Positions& landmarks) { return population_.cost(landmarks); };
    }
    std::vector<FaceSearch> searches;
    for (std::uint64_t index = from; index <= to; ++index) {
      const FaceDistribution& kind =
          distributions_[static_cast<std::size_t>(result_.group_indices[index - 1] + 1)];
      searches.emplace_back(
          [this, &kind, index](std::uint32_t attempt) {
            return random_face(casting_, index, attempt, kind);
          },
          judge_, diversity, DiversityOptions::candidate_count(index));
    }
    parallel_for_each(searches.size(), [&](std::size_t i) { searches[i].prepare(crowd); });
    for (std::uint64_t index = from; index <= to; ++index) {
      FaceSearch& search = searches[index - from];
      auto found = search.choose_face(
          crowd,
          [&](const FaceSpace::Point& point) {
            const auto why = family_separation.rejection_reason(point);
            return why ? why : changes.rejection_reason(point);
          },
          cost);
      result_.rejections.add(search.rejections());
      if (!found) {
        result_.shortfall =
            Shortfall{index - 1, search.rejections(), result_.group_indices[index - 1]};
        return;
      }
      if (cost) population_.add(found->landmarks);
      crowd.add(std::move(found->face), std::move(found->point));
      if (on_face_joined_) on_face_joined_(search.rejections());
    }
  }

  /// Moves all faces of `crowd` to `result_`. For each face that `result_` did not contain before,
  /// finds the nearest head and the nearest other face.
  void take_crowd(CrowdSoFar& crowd) {
    const std::size_t known = result_.crowd.size();
    result_.crowd = crowd.take_faces();
    result_.points = crowd.take_points();
    if (!result_.shortfall) find_nearest_neighbours(judge_, result_, known);
  }

  const CastingOptions& casting_;
  const FaceJudge& judge_;
  const FaceJoinedCallback& on_face_joined_;
  const std::vector<FaceDistribution> distributions_;
  PopulationBalance population_;
  std::size_t first_sampled_ = 0;  ///< index of the first sampled face in the crowd
  CastingResult result_;
};

}  // namespace

CastingResult cast_crowd(const CastingOptions& casting, const FaceJudge& judge,
                         const FaceJoinedCallback& on_face_joined) {
  return CrowdCaster(casting, judge, on_face_joined).cast();
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
