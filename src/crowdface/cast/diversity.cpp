// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/diversity.h"

namespace crowdface {

std::string_view name_of(Reason reason) {
  switch (reason) {
    case Reason::kMinDistance:
      return "min_distance";
    case Reason::kMinDistanceToFaces:
      return "min_distance_to_faces";
    case Reason::kMaxWeight:
      return "max_weight";
    case Reason::kImplausible:
      return "max_deviation";
    case Reason::kFlipped:
      return "max_flipped";
    case Reason::kStretched:
      return "max_stretch";
    case Reason::kIntersecting:
      return "max_intersecting";
    case Reason::kRejected:
      return "min_distance_to_rejected";
    case Reason::kGap:
      return "max_gap";
    case Reason::kExposed:
      return "max_exposed";
    case Reason::kFamily:
      break;
  }
  return "family";
}

}  // namespace crowdface
