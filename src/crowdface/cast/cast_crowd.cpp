// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/cast_crowd.h"

#include <algorithm>
#include <memory>

#include "crowdface/cast/apply_review.h"
#include "crowdface/cast/face_search.h"
#include "crowdface/cast/population.h"
#include "crowdface/cast/shares.h"
#include "crowdface/cast/spread.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

/// Number of faces whose candidates are drawn in parallel, before these faces are chosen one after
/// the other.
constexpr std::uint64_t kBatch = 64;

/// Casts faces 1 … count, each against all earlier faces.
void cast_first_fit(const CastingOptions& casting, const FaceJudge& judge,
                    const std::vector<FaceKind>& kinds, const FamilySeparation& family_separation,
                    CrowdSoFar& crowd, const FaceJoined& joined, CastingResult& result) {
  PopulationBalance population(casting.population);
  FaceSearch::Cost cost;
  if (!casting.population.empty()) {
    cost = [&](const Positions& landmarks) { return population.cost(landmarks); };
  }
  for (std::uint64_t first = 1; first <= casting.count; first += kBatch) {
    throw_if_interrupted();
    const std::uint64_t last = std::min(casting.count, first + kBatch - 1);
    std::vector<FaceSearch> searches;
    for (std::uint64_t index = first; index <= last; ++index) {
      const FaceKind& kind = kinds[static_cast<std::size_t>(result.kinds[index - 1] + 1)];
      searches.emplace_back(
          [&casting, &kind, index](std::uint32_t attempt) {
            return draw_face(casting, index, attempt, kind);
          },
          judge, casting.diversity, casting.diversity.candidates_for(index));
    }
    parallel_for_each(searches.size(), [&](std::size_t i) { searches[i].prepare(crowd); });
    for (std::uint64_t index = first; index <= last; ++index) {
      FaceSearch& search = searches[index - first];
      auto found = search.settle(
          crowd, [&](const FaceSpace::Point& point) { return family_separation.refuses(point); },
          cost);
      result.rejections.add(search.rejections());
      if (!found) {
        result.shortfall = Shortfall{index - 1, search.rejections(), result.kinds[index - 1]};
        return;
      }
      if (cost) population.add(found->landmarks);
      crowd.add(std::move(found->face), std::move(found->point));
      if (joined) joined(search.rejections());
    }
  }
}

/// Draws what a hand-written recipe does not specify, until the face meets the recipe's limits on
/// measurements. \return  nothing if no attempt does.
std::optional<FacePlan> draw_by_hand(const CastingOptions& casting, const ManualRecipe& hand,
                                     const FaceJudge& judge) {
  const auto attempts =
      kDrawsWithTraits * static_cast<std::uint32_t>(casting.diversity.max_attempts);
  for (std::uint32_t attempt = 0; attempt < attempts; ++attempt) {
    FacePlan face = draw_manual_recipe(casting, hand, attempt);
    const TraitRules* rules = hand.traits.empty() ? nullptr : judge.traits();
    if (rules == nullptr) return face;
    if (rules->check(face, rules->measurer().landmarks(face.recipe))) continue;
    if (!judge.check_traits(face)) return face;
  }
  return std::nullopt;
}

}  // namespace

CastingResult cast_crowd(const CastingOptions& casting, const FaceJudge& judge,
                         const FaceJoined& joined) {
  CastingResult result;
  auto so_far = std::make_unique<CrowdSoFar>(judge.space().dimensions());
  CrowdSoFar& crowd = *so_far;
  for (const ManualRecipe& hand : casting.recipes) {
    std::optional<FacePlan> face = draw_by_hand(casting, hand, judge);
    if (!face) {
      Rejections rejections;
      rejections.add(Reason::kTraits);
      result.shortfall = Shortfall{0, rejections, -1, {}, {}, hand.id};
      return result;
    }
    FaceSpace::Point point = judge.space().point(face->recipe);
    crowd.add(*std::move(face), std::move(point));
  }
  FamilySeparation family_separation;
  const UnrelatedFaces unrelated(casting, judge.space());
  for (const FamilyOptions& family : casting.families) {
    Rejections rejections;
    auto cast =
        cast_family(casting, family, judge, unrelated, crowd, family_separation, rejections);
    result.rejections.add(rejections);
    if (!cast) {
      result.shortfall = Shortfall{0, rejections, -1, family.name};
      return result;
    }
    result.families.push_back(std::move(*cast));
  }
  crowd.begin_sampled();
  result.kinds = schedule_groups(casting.groups, casting.count);
  const std::vector<FaceKind> kinds = face_kinds(casting);
  if (casting.diversity.mode == DiversityOptions::Mode::kSpread) {
    cast_spread(casting, judge, kinds, family_separation, crowd, joined, result);
  } else {
    cast_first_fit(casting, judge, kinds, family_separation, crowd, joined, result);
  }
  result.crowd = crowd.take_faces();
  result.points = crowd.take_points();
  so_far.reset();  // free the index, which is as large as the points
  if (result.shortfall) return result;
  find_nearest(judge, result);
  for (const Review& review : casting.reviews) {
    if (!result.shortfall) apply_review(casting, judge, review, result);
  }
  return result;
}

void find_nearest(const FaceJudge& judge, CastingResult& cast) {
  FacePointIndex index(judge.space().dimensions());
  for (const FaceSpace::Point& point : cast.points) index.add(point);
  parallel_for_each(index.size(), [&](Index i) {
    const FaceSpace::Point& point = cast.points[static_cast<std::size_t>(i)];
    const auto [head, head_mm] = judge.nearest_head(point);
    Nearest nearest{head, head_mm, std::nullopt, 0};
    if (i > 0) {
      const FacePointIndex::Nearest face = index.nearest(point, HUGE_VAL, 0, i);
      nearest.crowd = cast.crowd[static_cast<std::size_t>(face.face)].id;
      nearest.crowd_mm = face.mm;
    }
    cast.crowd[static_cast<std::size_t>(i)].notes.nearest = nearest;
  });
}

}  // namespace crowdface
