// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_judge.h"

#include <algorithm>
#include <utility>

#include "crowdface/cast/crowd_statistics.h"

namespace crowdface {

std::optional<Reason> exceeded_limit(const BelievabilityOptions& limits, const SkinDefects& skin) {
  const auto triangles = static_cast<double>(skin.local.compared);
  if (static_cast<double>(skin.local.flipped) > limits.max_flipped * triangles) {
    return Reason::kFlipped;
  }
  if (skin.local.stretch > limits.max_stretch) return Reason::kStretched;
  if (static_cast<double>(skin.intersecting) > limits.max_intersecting * triangles) {
    return Reason::kIntersecting;
  }
  if (skin.gap_excess_mm > limits.max_gap_mm) return Reason::kGap;
  if (skin.exposed_mm2 > limits.max_exposed_mm2) return Reason::kExposed;
  return std::nullopt;
}

FaceJudge::FaceJudge(const FaceSpace& space, const DiversityOptions& diversity,
                     const BelievabilityOptions& believability, const ProxySkin* skin,
                     FindMeshDefects meshes)
    : space_(space),
      diversity_(diversity),
      believability_(believability),
      heads_(space.dimensions()),
      plausibility_(space),
      skin_(skin),
      mesh_defects_(std::move(meshes)) {
  for (Index h = 0; h < space.head_point_count(); ++h) heads_.add(space.head_point(h));
  std::vector<FaceSpace::Point> heads;
  for (Index h = 0; h < space.head_count(); ++h) heads.push_back(space.head_point(h));
  // If the heads are similar to each other or small, a smaller limit applies.
  constexpr double kFractionOfMedian = 0.1;
  same_person_mm_ = std::min(DiversityOptions::kSamePersonMm,
                             kFractionOfMedian * quartiles(pair_distances(heads)).median);
}

std::optional<Reason> FaceJudge::check_traits(const FacePlan& face) const {
  if (traits_ == nullptr || traits_->limits_of(face).empty()) return std::nullopt;
  return traits_->check(face, traits_->measurer().exact_landmarks(face.recipe));
}

std::optional<Reason> FaceJudge::check_recipe(const Recipe& recipe,
                                              const FaceSpace::Point& point) const {
  for (const RegionRecipe& region : recipe.regions) {
    for (std::size_t b = 0; b < band_count(region); ++b) {
      for (const SourceWeight& source : band_of(region, b).weights) {
        if (source.weight > diversity_.max_weight) return Reason::kMaxWeight;
      }
    }
  }
  const double limit = diversity_.min_distance_to_faces_mm;
  if (limit > 0 && heads_.nearest(point, limit).face >= 0) return Reason::kMinDistanceToFaces;
  if (believability_.check && plausibility_.score(point) > believability_.max_deviation) {
    return Reason::kImplausible;
  }
  return std::nullopt;
}

std::optional<Reason> FaceJudge::check_candidate(const Recipe& recipe,
                                                 const FaceSpace::Point& point,
                                                 std::uint32_t earlier) const {
  if (const auto why = check_recipe(recipe, point)) return why;
  const bool passes_for_head = earlier < DiversityOptions::kCandidatesUnlikeHeads &&
                               heads_.nearest(point, same_person_mm_).face >= 0;
  return passes_for_head ? std::optional(Reason::kMinDistanceToFaces) : std::nullopt;
}

std::optional<Reason> FaceJudge::check_skin(const Recipe& whole) const {
  if (skin_ == nullptr || !believability_.check) return std::nullopt;
  // check the unmirrored face, because mirroring does not change its defects
  Recipe recipe = whole;
  recipe.mirrored = false;
  const Positions samples = sample_face(space_.sampled_heads(), recipe);
  std::optional<ProxySkin::Target> mixture;
  if (!recipe.mixture.empty() || recipe.asymmetry != 1) {
    mixture.emplace(skin_->target_of_samples(sample_target(space_.sampled_heads(), recipe)));
  }
  const ProxySkin::Target& target = mixture ? *mixture : skin_->target_of_head(recipe.target);
  SkinDefects defects{target.triangles.compare(samples), 0};
  if (const auto why = exceeded_limit(believability_, defects)) return why;
  defects.intersecting = skin_->intersecting_triangles(samples, target);
  if (const auto why = exceeded_limit(believability_, defects)) return why;
  return mesh_defects_ ? exceeded_limit(believability_, mesh_defects_(recipe)) : std::nullopt;
}

}  // namespace crowdface
