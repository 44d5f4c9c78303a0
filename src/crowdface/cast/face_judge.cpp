// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_judge.h"

#include <algorithm>
#include <utility>

#include "crowdface/cast/crowd_statistics.h"

namespace crowdface {

std::optional<RejectionReason> exceeded_limit(const BelievabilityOptions& limits,
                                              const SkinDefects& defects) {
  const auto triangles = static_cast<double>(defects.local.compared_triangle_count);
  if (static_cast<double>(defects.local.flipped_triangle_count) > limits.max_flipped * triangles) {
    return RejectionReason::kFlipped;
  }
  if (defects.local.stretch_factor > limits.max_stretch) return RejectionReason::kStretched;
  if (static_cast<double>(defects.intersecting_triangle_count) >
      limits.max_intersecting * triangles) {
    return RejectionReason::kIntersecting;
  }
  if (defects.gap_excess_mm > limits.max_gap_mm) return RejectionReason::kGap;
  if (defects.exposed_back_face_mm2 > limits.max_exposed_mm2) return RejectionReason::kExposed;
  return std::nullopt;
}

FaceJudge::FaceJudge(const FaceSpace& space, const DiversityOptions& diversity,
                     const BelievabilityOptions& believability, const ProxySkin* proxy_skin,
                     MeshDefectFinder find_mesh_defects)
    : space_(space),
      diversity_(diversity),
      believability_(believability),
      head_search_(space.dimensions()),
      plausibility_(space),
      proxy_skin_(proxy_skin),
      find_mesh_defects_(std::move(find_mesh_defects)) {
  for (Index h = 0; h < space.head_point_count(); ++h) head_search_.add(space.head_point(h));
  std::vector<FaceSpace::Point> heads;
  for (Index h = 0; h < space.head_count(); ++h) heads.push_back(space.head_point(h));
  // `same_person_mm_` is the smaller of two values: kSamePersonMm, and this fraction of the median
  // distance between two heads. (The median distance is small if the heads are similar to each
  // other, or if the meshes of the heads are small.)
  constexpr double kFractionOfMedian = 0.1;
  same_person_mm_ = std::min(DiversityOptions::kSamePersonMm,
                             kFractionOfMedian * quartiles(pair_distances(heads)).median);
}

Positions FaceJudge::landmarks(const Recipe& recipe) const {
  return !trait_rules_ ? Positions() : trait_rules_->measurer().landmarks(recipe);
}

std::optional<RejectionReason> FaceJudge::check_traits(const FacePlan& face,
                                                       const Positions& landmarks) const {
  return !trait_rules_ ? std::nullopt : trait_rules_->check(face, landmarks);
}

std::optional<RejectionReason> FaceJudge::check_traits(const FacePlan& face) const {
  if (!trait_rules_ || trait_rules_->limits_of(face).empty()) return std::nullopt;
  return trait_rules_->check(face, trait_rules_->measurer().exact_landmarks(face.recipe));
}

std::optional<RejectionReason> FaceJudge::check_recipe(const Recipe& recipe,
                                                       const FaceSpace::Point& point) const {
  for (const RegionRecipe& region : recipe.regions) {
    for (std::size_t b = 0; b < band_count(region); ++b) {
      for (const SourceWeight& source : band_of(region, b).weights) {
        if (source.weight > diversity_.max_weight) return RejectionReason::kMaxWeight;
      }
    }
  }
  const double limit = diversity_.min_distance_to_heads_mm;
  if (limit > 0 && head_search_.nearest(point, limit).face >= 0)
    return RejectionReason::kMinDistanceToHeads;
  if (believability_.check && plausibility_.score(point) > believability_.max_deviation) {
    return RejectionReason::kImplausible;
  }
  return std::nullopt;
}

std::optional<RejectionReason> FaceJudge::check_candidate(
    const Recipe& recipe, const FaceSpace::Point& point,
    std::uint32_t earlier_candidate_count) const {
  if (const auto why = check_recipe(recipe, point)) return why;
  const bool is_same_person_as_head =
      earlier_candidate_count < DiversityOptions::kCandidatesCheckedForSamePerson &&
      head_search_.nearest(point, same_person_mm_).face >= 0;
  return is_same_person_as_head ? std::optional(RejectionReason::kMinDistanceToHeads)
                                : std::nullopt;
}

std::optional<RejectionReason> FaceJudge::check_skin(const Recipe& whole) const {
  if (proxy_skin_ == nullptr || !believability_.check) return std::nullopt;
  // check the unmirrored face, because a face and its mirror image have the same defects
  Recipe recipe = whole;
  recipe.mirrored = false;
  const Positions samples = sample_face(space_.heads_at_samples(), recipe);
  std::optional<ProxySkin::ReferenceSkin> mixture;
  if (!recipe.mixture.empty() || recipe.asymmetry != 1) {
    mixture.emplace(
        proxy_skin_->make_reference_skin(sample_target(space_.heads_at_samples(), recipe)));
  }
  const ProxySkin::ReferenceSkin& reference =
      mixture ? *mixture : proxy_skin_->reference_skin_of_head(recipe.target);
  SkinDefects defects{reference.triangles.compare(samples), 0};
  if (const auto why = exceeded_limit(believability_, defects)) return why;
  defects.intersecting_triangle_count =
      proxy_skin_->count_newly_intersecting_triangles(samples, reference);
  if (const auto why = exceeded_limit(believability_, defects)) return why;
  return find_mesh_defects_ ? exceeded_limit(believability_, find_mesh_defects_(recipe))
                            : std::nullopt;
}

}  // namespace crowdface
