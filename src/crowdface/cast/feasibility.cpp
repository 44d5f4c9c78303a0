// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/feasibility.h"

#include <cmath>

namespace crowdface {
namespace {

constexpr int kTries = 9;
/// Draws that all tries together may take; one that has begun is finished.
constexpr std::uint64_t kMostDraws = 400'000;

double whole_hundredths(double mm) {
  return std::floor(mm * 100) / 100;
}

}  // namespace

Remedy find_remedy(const Casting& casting, const FaceSpace& space,
                   const BelievabilityOptions& believability, const Shortfall& shortfall) {
  Remedy remedy;
  remedy.binding = shortfall.rejections.main();
  Casting easier = casting;
  double* distance = nullptr;
  if (remedy.binding == Reason::kMinDistance) {
    distance = &easier.diversity.min_distance_mm;
  } else if (remedy.binding == Reason::kMinDistanceToFaces) {
    distance = &easier.diversity.min_distance_to_faces_mm;
  } else {
    return remedy;
  }
  easier.diversity.candidates = casting.diversity.candidate_count();
  double works = 0, fails = *distance;
  std::uint64_t draws = 0;
  for (int i = 0; i < kTries && draws < kMostDraws; ++i) {
    *distance = whole_hundredths(0.5 * (works + fails));
    if (*distance <= works) break;
    const FaceJudge judge(space, easier.diversity, believability);
    const CrowdCast cast = cast_crowd(easier, judge);
    draws += cast.rejections.total() + cast.crowd.size();
    if (cast.shortfall) {
      fails = *distance;
    } else {
      works = *distance;
      remedy.largest_mm = works;
    }
  }
  return remedy;
}

}  // namespace crowdface
