// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/families.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "crowdface/core/interrupt.h"

namespace crowdface {
namespace {

constexpr std::uint32_t kMaxFounders = 12;  ///< number of founders to try before giving up
/// number of pairs of new parents that are tried until a pair matches well; if none does,
/// kMaxFounders further pairs are tried without this condition
constexpr std::uint32_t kMaxCouples = 200;
/// largest number of candidates that are tried for each founder
constexpr std::uint32_t kMaxAttemptsPerFounder = 64;
/// number of acceptable candidates among which the founder of a family without parents is chosen
constexpr int kCandidatesPerFounder = 24;

/// Returns the options of the search for a founder. A founder is not part of the crowd, so the
/// founder may be at any distance from the crowd's faces.
DiversityOptions options_of_founder(DiversityOptions diversity) {
  diversity.min_distance_mm = 0;
  diversity.max_attempts = kMaxAttemptsPerFounder;
  return diversity;
}

/// Finds a family's members, each far enough from the crowd and from the members found before.
/// Returns fewer members if there is no room.
std::vector<FaceSearch::FoundFace> find_members(const CastingOptions& casting,
                                                const FamilyOptions& family, const FaceJudge& judge,
                                                const FamilySampler& sampler,
                                                const FamilyPlan& cast, const CrowdSoFar& crowd,
                                                const FamilySeparation& family_separation,
                                                RejectionCounts& rejections) {
  std::vector<FaceSearch::FoundFace> members;
  std::vector<FaceSpace::Point> own;
  while (static_cast<int>(members.size()) < family.member_count) {
    const int number = static_cast<int>(members.size()) + 1;
    FaceSearch search([&](std::uint32_t attempt) { return sampler.member(cast, number, attempt); },
                      judge, casting.diversity, 1);
    auto member = search.choose_face(crowd, [&](const FaceSpace::Point& point) {
      return sampler.distance_to_new_parent_mm(point) < casting.diversity.min_distance_mm
                 ? std::optional(RejectionReason::kMinDistance)
                 : sampler.rejection_reason(cast, point, own, family_separation);
    });
    rejections.add(search.rejections());
    if (!member) break;
    own.push_back(member->point);
    members.push_back(std::move(*member));
  }
  return members;
}

}  // namespace

std::optional<FamilyPlan> cast_family(const CastingOptions& casting, const FamilyOptions& family,
                                      const FaceJudge& judge, const UnrelatedFaces& unrelated,
                                      CrowdSoFar& crowd, FamilySeparation& family_separation,
                                      RejectionCounts& rejections) {
  FamilySampler sampler(casting, family, judge, unrelated, crowd);
  const DiversityOptions of_founder = options_of_founder(casting.diversity);
  const bool drawn = sampler.needs_parents();
  const std::uint32_t attempts_each = kMaxAttemptsPerFounder * max_attempts_factor(casting);
  for (std::uint32_t f = 0; f < (drawn ? kMaxCouples + kMaxFounders : kMaxFounders); ++f) {
    throw_if_interrupted();
    if (drawn && !sampler.sample_parents(crowd, family_separation, f, rejections))
      return std::nullopt;
    // Find a founder, the face from which the members are derived. If parents of the family were
    // made anew, they must resemble this founder; otherwise try other parents.
    FaceSearch founder([&](std::uint32_t attempt) { return sampler.founder(attempt); }, judge,
                       of_founder, family.parents.empty() ? kCandidatesPerFounder : 1,
                       f * attempts_each);
    auto found = founder.choose_face(crowd);
    rejections.add(founder.rejections());
    if (!found) continue;
    const double fraction_nearer = sampler.fraction_of_strangers_nearer_than_parent(found->point);
    // `fraction_nearer` is the fraction of strangers that are nearer to the founder than the
    // farther parent is. New parents are accepted if this fraction is at most `max_fraction`. This
    // limit grows with the number of tries: if both parents are new, the search soon finds a pair
    // that matches well, but if one parent is given, perhaps no new parent matches this parent
    // well.
    const double max_fraction =
        kMaxFractionOfNearerStrangersForFounder * (0.5 + static_cast<double>(f) / kMaxCouples);
    if (drawn && f < kMaxCouples && fraction_nearer > max_fraction) continue;
    FamilyPlan cast{family.name, std::move(found->face), std::move(found->point)};
    // For twins, a hidden child who is not part of the crowd replaces the founder.
    if (family.are_twins) {
      FaceSearch model(
          [&](std::uint32_t attempt) { return sampler.twins_prototype(cast, attempt); }, judge,
          of_founder, 1, f * attempts_each);
      auto child = model.choose_face(crowd, [&](const FaceSpace::Point& point) {
        const bool too_far = fraction_nearer <= kMaxFractionOfNearerStrangersForFounder &&
                             sampler.fraction_of_strangers_nearer_than_parent(point) >
                                 kMaxFractionOfNearerStrangersForFounder;
        return too_far ? std::optional(RejectionReason::kFamily)
                       : sampler.rejection_reason(cast, point, {}, family_separation);
      });
      rejections.add(model.rejections());
      if (!child) continue;
      cast = {family.name, std::move(child->face), std::move(child->point), true};
    }
    // Find room for all members. If there is not enough room, try the next founder.
    auto members =
        find_members(casting, family, judge, sampler, cast, crowd, family_separation, rejections);
    if (static_cast<int>(members.size()) < family.member_count) continue;
    // Add the new parents and the members to the crowd.
    for (const FaceSearch::FoundFace& parent : sampler.new_parents()) {
      crowd.add(parent.face, parent.point);
    }
    cast.members_begin = crowd.size();
    cast.members_end = cast.members_begin + family.member_count;
    std::vector<FaceSpace::Point> points;
    for (FaceSearch::FoundFace& member : members) {
      points.push_back(member.point);
      crowd.add(std::move(member.face), std::move(member.point));
    }
    family_separation.add(family.name, points);
    for (const FaceSpace::Point& child : points) {
      cast.fraction_of_strangers_nearer_than_parent =
          std::max(cast.fraction_of_strangers_nearer_than_parent,
                   sampler.fraction_of_strangers_nearer_than_parent(child));
    }
    return cast;
  }
  return std::nullopt;
}

double mean_silhouette_coefficient(const std::vector<FamilyPlan>& families, std::size_t family,
                                   const std::vector<FaceSpace::Point>& points) {
  const FamilyPlan& own = families[family];
  using Faces = std::pair<Index, Index>;  // index ranges [first, second)
  const auto mean_distance = [&](Index from, std::initializer_list<Faces> to) {
    double sum = 0, count = 0;
    for (const auto& [begin, end] : to) {
      for (Index other = begin; other < end; ++other) {
        if (other == from) continue;
        sum += FaceSpace::distance(points[static_cast<std::size_t>(from)],
                                   points[static_cast<std::size_t>(other)]);
        count += 1;
      }
    }
    return count == 0 ? 0.0 : sum / count;
  };
  const auto all = static_cast<Index>(points.size());
  double sum = 0;
  for (Index i = own.members_begin; i < own.members_end; ++i) {
    const double a = mean_distance(i, {{own.members_begin, own.members_end}});
    double b = HUGE_VAL;
    for (std::size_t f = 0; f < families.size(); ++f) {
      if (f == family || families[f].members_begin == families[f].members_end) continue;
      b = std::min(b, mean_distance(i, {{families[f].members_begin, families[f].members_end}}));
    }
    if (families.size() == 1 && own.members_end - own.members_begin < all) {
      b = mean_distance(i, {{0, own.members_begin}, {own.members_end, all}});
    }
    if (b < HUGE_VAL && std::max(a, b) > 0) sum += (b - a) / std::max(a, b);
  }
  return own.members_end > own.members_begin
             ? sum / static_cast<double>(own.members_end - own.members_begin)
             : 0;
}

}  // namespace crowdface
