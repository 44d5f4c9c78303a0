// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_judge.h"

#include <algorithm>

namespace crowdface {

FaceJudge::FaceJudge(const FaceSpace& space, const DiversityOptions& diversity,
                     const BelievabilityOptions& believability)
    : space_(space),
      diversity_(diversity),
      believability_(believability),
      heads_(space.dimensions()),
      plausibility_(space) {
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

}  // namespace crowdface
