// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/apply_review.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "crowdface/cast/band_order.h"
#include "crowdface/cast/crowd_statistics.h"
#include "crowdface/cast/face_changes.h"
#include "crowdface/cast/face_search.h"
#include "crowdface/cast/shares.h"
#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// A face to redraw, and the mark with which a review rejects this face.
struct Redraw {
  Index face = 0;
  const ReviewMark* mark = nullptr;
};

const FamilyPlan* family_of(const CastingResult& cast, Index face) {
  for (const FamilyPlan& family : cast.families) {
    if (face >= family.members_begin && face < family.members_end) return &family;
  }
  return nullptr;
}

std::vector<Redraw> read_marks(const Review& review, CastingResult& cast) {
  std::map<std::string, Index> faces;
  for (std::size_t i = 0; i < cast.crowd.size(); ++i) {
    faces[cast.crowd[i].id] = static_cast<Index>(i);
  }
  std::vector<Redraw> redraws;
  for (const ReviewMark& mark : review.marks) {
    const auto found = faces.find(mark.id);
    if (found == faces.end()) {
      throw InvalidInput(
          concat("the review names ", quoted(mark.id), ", which is not in the crowd"));
    }
    if (mark.note) cast.crowd[static_cast<std::size_t>(found->second)].notes.review = mark.note;
    if (mark.verdict == ReviewMark::Verdict::kReject) redraws.push_back({found->second, &mark});
  }
  std::ranges::sort(redraws, {}, &Redraw::face);
  return redraws;
}

class FaceRedrawer {
 public:
  FaceRedrawer(const CastingOptions& casting, const FaceJudge& judge, CastingResult& cast)
      : casting_(casting),
        judge_(judge),
        cast_(cast),
        unrelated_(casting, judge.space()),
        half_median_mm_(0.5 * quartiles(pair_distances(cast.points)).median),
        distributions_(face_distributions(casting)) {}

  /// Casts a new face to replace a rejected face.
  ///
  /// \return  false if no face was found.
  bool redraw(const Redraw& redraw, std::vector<bool>& is_final) {
    const auto at = static_cast<std::size_t>(redraw.face);
    const FacePlan old = cast_.crowd[at];
    const FamilyPlan* family = family_of(cast_, redraw.face);
    // The crowd's minimum distance applies to all faces outside the redrawn face's family. The
    // family has its own limits on the distances between its members.
    CrowdSoFar others(judge_.space().dimensions());
    std::vector<FaceSpace::Point> own;
    for (std::size_t i = 0; i < cast_.crowd.size(); ++i) {
      if (!is_final[i]) continue;
      if (family != nullptr && family_of(cast_, static_cast<Index>(i)) == family) {
        own.push_back(cast_.points[i]);
      } else {
        others.add(cast_.crowd[i], cast_.points[i]);
      }
    }
    const FamilySeparation family_separation = family_separation_without(family, is_final);
    const AvoidedFaces changes(cast_, casting_.diversity.min_distance_mm, is_final);
    FaceSearch::GenerateCandidate generate;
    const std::vector<FaceSpace::Point> rejected = reject(at);
    FaceSearch::RejectionCheck rejection_reason;
    std::optional<FamilySampler> family_draws;
    if (family != nullptr) {
      const FamilyOptions& options = options_of(*family);
      family_draws.emplace(casting_, options, judge_, unrelated_, others);
      const int member = static_cast<int>(redraw.face - family->members_begin) + 1;
      generate = [&, member](std::uint32_t attempt) {
        return family_draws->member(*family, member, attempt);
      };
      rejection_reason = [&](const FaceSpace::Point& point) {
        return family_draws->rejection_reason(*family, point, own, family_separation);
      };
    } else {
      generate = [&](std::uint32_t attempt) {
        return random_face(casting_, *old.index, attempt, distribution_of_face(*old.index));
      };
      rejection_reason = [&](const FaceSpace::Point& point) {
        return family_separation.rejection_reason(point);
      };
    }
    const int candidates = old.index ? casting_.diversity.candidate_count(*old.index) : 1;
    std::optional<FaceSearch::FoundFace> found;
    RejectionCounts rejections;
    for (const double least : distances_to_rejected(family, own, *redraw.mark)) {
      FaceSearch search(
          [&](std::uint32_t attempt) { return with_locked(generate(attempt), old, *redraw.mark); },
          judge_, casting_.diversity, candidates, old.notes.attempt + 1);
      found = search.choose_face(
          others, [&](const FaceSpace::Point& point) -> std::optional<RejectionReason> {
            for (const FaceSpace::Point& other : rejected) {
              if (FaceSpace::distance(point, other) < least) return RejectionReason::kRejected;
            }
            const auto why = rejection_reason(point);
            return why ? why : changes.rejection_reason(point);
          });
      rejections.add(search.rejections());
      if (found) break;
    }
    cast_.rejections.add(rejections);
    if (!found) {
      cast_.shortfall =
          Shortfall{casting_.count, rejections, -1, Shortfall::What::kRedrawnFace, old.id};
      return false;
    }
    store_redrawn_face(at, std::move(*found), old, is_final);
    is_final[at] = true;
    return true;
  }

 private:
  /// Records that a face was rejected.
  ///
  /// \return  The face-space points of the rejected face and of its earlier rejected versions.
  std::vector<FaceSpace::Point> reject(std::size_t face) {
    cast_.rejected.push_back(cast_.crowd[face]);
    cast_.crowd_size_at_rejection.push_back(cast_.crowd.size());
    std::vector<FaceSpace::Point> points;
    for (const FacePlan& old : cast_.rejected) {
      if (old.id == cast_.crowd[face].id) points.push_back(judge_.space().point(old.recipe));
    }
    return points;
  }

  /// Returns the minimum distances between the new face and all rejected versions of the face, in
  /// the order in which the redraw tries these distances: largest first. Smaller distances are
  /// needed because a family or locked bands may make the largest distance impossible.
  ///
  /// \param own  Points of the other members of the face's family.
  std::vector<double> distances_to_rejected(const FamilyPlan* family,
                                            const std::vector<FaceSpace::Point>& own,
                                            const ReviewMark& mark) const {
    if (casting_.diversity.min_distance_to_rejected_mm) {
      return {*casting_.diversity.min_distance_to_rejected_mm};
    }
    if (family == nullptr && mark.locked_bands.empty()) return {half_median_mm_};
    double free = 1;
    const std::size_t bands = band_count(casting_.sampling);
    for (const std::size_t part : mark.locked_bands) {
      free -= judge_.space().region_area_fraction(static_cast<Index>(part / bands)) /
              static_cast<double>(bands);
    }
    const double all = family == nullptr
                           ? half_median_mm_
                           : std::min(half_median_mm_, 0.5 * quartiles(pair_distances(own)).max);
    const double least = all * std::sqrt(std::max(free, 0.0));
    return {least, least / 2, least / 4, 0};
  }

  const FamilyOptions& options_of(const FamilyPlan& family) const {
    return *std::ranges::find(casting_.families, family.name, &FamilyOptions::name);
  }

  const FaceDistribution& distribution_of_face(std::uint64_t index) const {
    return distributions_[static_cast<std::size_t>(cast_.group_indices[index - 1] + 1)];
  }

  /// Copies the locked bands of the old face. Also copies the old face's target, mirroring and
  /// asymmetry, because the locked bands would look different without these values.
  FacePlan with_locked(FacePlan face, const FacePlan& old, const ReviewMark& mark) const {
    if (mark.locked_bands.empty()) return face;
    if (face.recipe.target != old.recipe.target && old.index) {
      FaceDistribution kind = distribution_of_face(*old.index);
      kind.targets = {{old.recipe.target, 1}};
      face = random_face(casting_, *old.index, face.notes.attempt, kind);
    }
    copy_locked_bands(mark.locked_bands, old.recipe, face.recipe);
    return face;
  }

  FamilySeparation family_separation_without(const FamilyPlan* own,
                                             const std::vector<bool>& is_final) const {
    FamilySeparation family_separation;
    for (const FamilyPlan& family : cast_.families) {
      if (&family == own) continue;
      std::vector<FaceSpace::Point> members;
      for (Index i = family.members_begin; i < family.members_end; ++i) {
        const auto at = static_cast<std::size_t>(i);
        if (is_final[at]) members.push_back(cast_.points[at]);
      }
      family_separation.add(family.name, members);
    }
    return family_separation;
  }

  void store_redrawn_face(std::size_t at, FaceSearch::FoundFace found, const FacePlan& old,
                          const std::vector<bool>& is_final) {
    found.face.notes.nearest = nearest_neighbours(judge_, cast_, found.point, is_final);
    found.face.notes.review = old.notes.review;
    cast_.crowd[at] = std::move(found.face);
    cast_.points[at] = std::move(found.point);
  }

  const CastingOptions& casting_;
  const FaceJudge& judge_;
  CastingResult& cast_;
  UnrelatedFaces unrelated_;
  double half_median_mm_;
  std::vector<FaceDistribution> distributions_;
};

}  // namespace

void apply_review(const CastingOptions& crowd_options, const FaceJudge& judge,
                  std::size_t review_index, CastingResult& cast) {
  const Review& review = crowd_options.reviews[review_index];
  CastingOptions casting = crowd_options;
  casting.diversity.min_distance_mm =
      review.min_distance_mm.value_or(casting.diversity.min_distance_mm);
  std::vector<Redraw> redraws = read_marks(review, cast);
  std::vector<FaceChange> changes;
  std::erase_if(redraws, [&](const Redraw& redraw) {
    const auto changed = cast.changed.find(static_cast<std::size_t>(redraw.face));
    const bool acts_as_change = !redraw.mark->locked_bands.empty() &&
                                changed != cast.changed.end() && changed->second.is_other_person;
    if (acts_as_change) {
      changes.emplace_back().id = redraw.mark->id;
      changes.back().locked_bands = redraw.mark->locked_bands;
    }
    return acts_as_change;
  });
  std::vector<bool> is_final(cast.crowd.size(), true);
  for (const Redraw& redraw : redraws) is_final[static_cast<std::size_t>(redraw.face)] = false;
  FaceRedrawer redrawing(casting, judge, cast);
  for (const Redraw& redraw : redraws) {
    if (!redrawing.redraw(redraw, is_final)) return;
  }
  for (const Redraw& redraw : redraws) {
    reapply_changes(casting, judge, static_cast<std::size_t>(redraw.face), cast);
  }
  changes.insert(changes.end(), review.changes.begin(), review.changes.end());
  apply_changes(casting, judge, changes, concat("review ", review_index + 1), cast);
}

}  // namespace crowdface
