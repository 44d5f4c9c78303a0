// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_judge.h"

#include <algorithm>

namespace crowdface {

FaceJudge::FaceJudge(const FaceSpace& space, const DiversityOptions& diversity,
                     const BelievabilityOptions& believability, const ProxySkin* skin)
    : space_(space),
      diversity_(diversity),
      believability_(believability),
      heads_(space.dimensions()),
      plausibility_(space),
      skin_(skin) {
  for (Index h = 0; h < space.head_count(); ++h) heads_.add(space.place_head(h));
}

std::optional<Reason> FaceJudge::at_a_glance(const Recipe& recipe,
                                             const FaceSpace::Place& place) const {
  for (const RegionRecipe& region : recipe.regions) {
    for (const SourceWeight& source : region.weights) {
      if (source.weight > diversity_.max_weight) return Reason::kMaxWeight;
    }
  }
  const double limit = diversity_.min_distance_to_faces_mm;
  if (limit > 0 && heads_.nearest(place, limit).face >= 0) return Reason::kMinDistanceToFaces;
  if (believability_.check && plausibility_.score(place) > believability_.max_deviation) {
    return Reason::kImplausible;
  }
  return std::nullopt;
}

std::optional<Reason> FaceJudge::closely(const Recipe& recipe) const {
  if (skin_ == nullptr || !believability_.check) return std::nullopt;
  const Positions samples = sample_face(space_.sampled(), recipe, Variant::kAsBuilt);
  const LocalDefects defects = skin_->local(samples, recipe.target);
  const auto triangles = static_cast<double>(defects.compared);
  if (static_cast<double>(defects.flipped) > believability_.max_flipped * triangles) {
    return Reason::kFlipped;
  }
  if (defects.stretch > believability_.max_stretch) return Reason::kStretched;
  const Index intersecting = skin_->intersecting_triangles(samples, recipe.target);
  if (static_cast<double>(intersecting) > believability_.max_intersecting * triangles) {
    return Reason::kIntersecting;
  }
  return std::nullopt;
}

}  // namespace crowdface
