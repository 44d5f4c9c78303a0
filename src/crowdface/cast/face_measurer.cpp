// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_measurer.h"

#include <algorithm>

namespace crowdface {

Positions FaceMeasurer::landmarks(const Recipe& recipe) const {
  const Positions samples = sample_face(heads_, recipe);
  Positions points = Positions::Zero(static_cast<Index>(landmarks_.size()), 3);
  for (std::size_t l = 0; l < landmarks_.size(); ++l) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (landmarks_[l].weights[c] == 0) continue;
      points.row(static_cast<Index>(l)) +=
          landmarks_[l].weights[c] * samples.row(landmarks_[l].samples[c]);
    }
  }
  return points;
}

bool FaceMeasurer::meets(const TraitLimits& limits, const Positions& landmarks) const {
  return std::ranges::all_of(limits, [&](const TraitLimit& limit) {
    const bool is_limit = limit.at_least || limit.at_most;
    return !is_limit ||
           head_distributions_.meets(limit, measure(measurements()[limit.trait], landmarks));
  });
}

}  // namespace crowdface
