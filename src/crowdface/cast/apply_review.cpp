// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/apply_review.h"

#include <algorithm>
#include <map>

#include "crowdface/cast/face_search.h"
#include "crowdface/cast/quotas.h"
#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// A face that is drawn anew, and how.
struct Redraw {
  Index face = 0;
  const ReviewMark* mark = nullptr;
};

const FamilyCast* family_of(const CrowdCast& cast, Index face) {
  for (const FamilyCast& family : cast.families) {
    if (face >= family.begin && face < family.end) return &family;
  }
  return nullptr;
}

std::vector<Redraw> read_marks(const Review& review, CrowdCast& cast) {
  std::map<std::string, Index> faces;
  for (std::size_t i = 0; i < cast.crowd.size(); ++i) {
    faces[cast.crowd[i].id] = static_cast<Index>(i);
  }
  std::vector<Redraw> redraws;
  for (const ReviewMark& mark : review) {
    const auto found = faces.find(mark.id);
    if (found == faces.end()) {
      throw InvalidInput(
          concat("the review names ", quoted(mark.id), ", which is not in the crowd"));
    }
    if (mark.note) cast.crowd[static_cast<std::size_t>(found->second)].notes.review = mark.note;
    if (mark.verdict == ReviewMark::Verdict::kReject) redraws.push_back({found->second, &mark});
  }
  std::sort(redraws.begin(), redraws.end(),
            [](const Redraw& a, const Redraw& b) { return a.face < b.face; });
  return redraws;
}

class Redrawing {
 public:
  Redrawing(const Casting& casting, const FaceJudge& judge, CrowdCast& cast)
      : casting_(casting),
        judge_(judge),
        cast_(cast),
        targets_of_(targets_by_quota(casting.sampling.targets, casting.diversity.quotas)) {}

  /// \return false if no face was found.
  bool redraw(const Redraw& redraw, std::vector<bool>& settled) {
    const auto at = static_cast<std::size_t>(redraw.face);
    const CastFace old = cast_.crowd[at];
    const FamilyCast* family = family_of(cast_, redraw.face);
    // Relatives are measured apart: a family's own distances hold among them.
    CrowdSoFar others(judge_.space().dimensions());
    std::vector<FaceSpace::Point> own;
    for (std::size_t i = 0; i < cast_.crowd.size(); ++i) {
      if (!settled[i]) continue;
      const bool relative = family != nullptr && family_of(cast_, static_cast<Index>(i)) == family;
      if (relative) {
        own.push_back(cast_.points[i]);
      } else {
        others.add(cast_.crowd[i], cast_.points[i]);
      }
    }
    const Kinship kinship = kinship_without(family, settled);
    FaceSearch::Draw draw;
    FaceSearch::Refuses refuses;
    std::optional<FamilyDraws> family_draws;
    if (family != nullptr) {
      const FamilyOptions& options = options_of(*family);
      family_draws.emplace(casting_, options, judge_, others);
      const int member = static_cast<int>(redraw.face - family->begin) + 1;
      draw = [&, member](std::uint32_t attempt) {
        return family_draws->member(*family, member, attempt);
      };
      refuses = [&](const FaceSpace::Point& point) {
        return family_draws->refuses(*family, point, own, kinship);
      };
    } else {
      draw = [&](std::uint32_t attempt) { return drawn_face(old, attempt); };
      refuses = [&](const FaceSpace::Point& point) { return kinship.intrudes(point); };
    }
    const int candidates = old.index ? casting_.diversity.candidates_for(*old.index) : 1;
    FaceSearch search(
        [&](std::uint32_t attempt) { return with_locked(draw(attempt), old, *redraw.mark); },
        judge_, casting_.diversity, candidates, old.notes.attempt + 1);
    auto found = search.settle(others, refuses);
    cast_.rejections.add(search.rejections());
    if (!found) {
      cast_.shortfall = Shortfall{casting_.count, search.rejections(), -1, {}, old.id};
      return false;
    }
    settle(at, std::move(*found), old, settled);
    settled[at] = true;
    return true;
  }

 private:
  const FamilyOptions& options_of(const FamilyCast& family) const {
    return *std::find_if(casting_.families.begin(), casting_.families.end(),
                         [&](const FamilyOptions& options) { return options.name == family.name; });
  }

  CastFace drawn_face(const CastFace& old, std::uint32_t attempt) const {
    if (!old.index) {  // hand-written: what it leaves open
      const auto hand = std::find_if(casting_.recipes.begin(), casting_.recipes.end(),
                                     [&](const HandRecipe& recipe) { return recipe.id == old.id; });
      return draw_recipe(casting_, *hand, {0, attempt, concat("recipe/", old.id)},
                         casting_.sampling.targets);
    }
    const int quota = cast_.quotas[*old.index - 1];
    return draw_face(casting_, *old.index, attempt,
                     targets_of_[static_cast<std::size_t>(quota + 1)]);
  }

  /// A region can only stay as it is on the same target.
  CastFace with_locked(CastFace face, const CastFace& old, const ReviewMark& mark) const {
    if (mark.locked.empty()) return face;
    if (face.recipe.target != old.recipe.target && old.index) {
      face = draw_face(casting_, *old.index, face.notes.attempt, {{old.recipe.target, 1}});
    }
    face.recipe.target = old.recipe.target;
    for (const std::size_t region : mark.locked) {
      face.recipe.regions[region] = old.recipe.regions[region];
    }
    return face;
  }

  Kinship kinship_without(const FamilyCast* own, const std::vector<bool>& settled) const {
    Kinship kinship;
    for (const FamilyCast& family : cast_.families) {
      if (&family == own) continue;
      std::vector<FaceSpace::Point> members;
      for (Index i = family.begin; i < family.end; ++i) {
        const auto at = static_cast<std::size_t>(i);
        if (settled[at]) members.push_back(cast_.points[at]);
      }
      kinship.add(family.name, members);
    }
    return kinship;
  }

  void settle(std::size_t at, FaceSearch::Found found, const CastFace& old,
              const std::vector<bool>& settled) {
    Nearest nearest;
    const FacePointIndex::Nearest head = judge_.nearest_head(found.point);
    nearest.head = head.face;
    nearest.head_mm = head.mm;
    double mm = HUGE_VAL;
    for (std::size_t i = 0; i < cast_.crowd.size(); ++i) {
      if (!settled[i]) continue;
      const double distance = FaceSpace::distance(found.point, cast_.points[i]);
      if (distance >= mm) continue;
      mm = distance;
      nearest.crowd = cast_.crowd[i].id;
      nearest.crowd_mm = mm;
    }
    found.face.notes.nearest = nearest;
    found.face.notes.review = old.notes.review;
    cast_.crowd[at] = std::move(found.face);
    cast_.points[at] = std::move(found.point);
  }

  const Casting& casting_;
  const FaceJudge& judge_;
  CrowdCast& cast_;
  TargetsOfQuota targets_of_;
};

}  // namespace

void apply_review(const Casting& casting, const FaceJudge& judge, const Review& review,
                  CrowdCast& cast) {
  const std::vector<Redraw> redraws = read_marks(review, cast);
  std::vector<bool> settled(cast.crowd.size(), true);
  for (const Redraw& redraw : redraws) settled[static_cast<std::size_t>(redraw.face)] = false;
  Redrawing redrawing(casting, judge, cast);
  for (const Redraw& redraw : redraws) {
    if (!redrawing.redraw(redraw, settled)) return;
  }
}

}  // namespace crowdface
