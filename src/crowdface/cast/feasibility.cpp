// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/feasibility.h"

#include <algorithm>
#include <cmath>

namespace crowdface {
namespace {

/// Largest number of draws in all trials together; a trial that has begun is finished.
constexpr std::uint64_t kMaxDraws = 20'000;
/// Largest number of faces in a trial.
constexpr std::uint64_t kMaxTried = 400;
/// Stop when the smallest value that fails is at most this factor times the largest that works.
constexpr double kNearEnough = 1.12;

double whole_hundredths(double mm) {
  return std::floor(mm * 100) / 100;
}

}  // namespace

Remedy find_remedy(const CastingOptions& casting, const FaceSpace& space,
                   const BelievabilityOptions& believability, const ProxySkin* skin,
                   const Shortfall& shortfall, const std::function<void()>& tried,
                   const TraitRules* traits) {
  Remedy remedy;
  remedy.binding = shortfall.rejections.most_frequent();
  CastingOptions easier = casting;
  if (!shortfall.family.empty() || !shortfall.reviewed.empty() || !shortfall.recipe.empty() ||
      !shortfall.changed.empty()) {
    return remedy;
  }
  easier.reviews.clear();
  easier.changes.clear();
  easier.count = std::min(casting.count, kMaxTried);
  remedy.tried = easier.count;
  const Constraint& constraint = constraint_of(remedy.binding);
  if (!constraint.is_distance()) return remedy;
  double& distance = easier.diversity.*constraint.diversity;
  // Faces fill a space of about five dimensions, so a slightly smaller distance fits many more.
  double works = 0, fails = distance;
  double next = fails * std::pow((static_cast<double>(shortfall.reached) + 0.5) /
                                     (static_cast<double>(easier.count) + 1),
                                 0.2);
  next = std::min(next, fails);
  for (std::uint64_t draws = 0; draws < kMaxDraws || works == 0;) {
    distance = whole_hundredths(next);
    if (distance <= works) break;
    FaceJudge judge(space, easier.diversity, believability, skin);
    judge.limit_traits(traits);
    const CastingResult cast = cast_crowd(easier, judge);
    draws += cast.rejections.total() +
             cast.crowd.size() * static_cast<std::uint64_t>(easier.diversity.candidates_for(1));
    if (tried) tried();
    if (cast.shortfall) {
      fails = distance;
      next = works > 0 ? std::sqrt(works * fails) : 0.7 * fails;
    } else {
      works = distance;
      remedy.largest_mm = works;
      next = std::sqrt(works * fails);
    }
    if (works > 0 && fails < kNearEnough * works) break;
  }
  return remedy;
}

std::optional<Shortfall> hopeless_spread(const CastingOptions& casting, const FaceJudge& judge) {
  constexpr std::uint64_t kBetter = 8;  // with a margin: spread finds twice as many faces at most
  const bool is_large = casting.count > kBetter * kMaxTried;
  if (casting.diversity.mode != DiversityOptions::Mode::kSpread || !is_large ||
      !(casting.diversity.min_distance_mm > 0)) {
    return std::nullopt;
  }
  CastingOptions first_fit = casting;
  first_fit.diversity.mode = DiversityOptions::Mode::kFirstFit;
  first_fit.reviews.clear();
  first_fit.changes.clear();
  first_fit.count = kMaxTried;
  return cast_crowd(first_fit, judge).shortfall;
}

}  // namespace crowdface
