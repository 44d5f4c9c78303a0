// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/cast/believability.h"
#include "crowdface/cast/diversity.h"
#include "crowdface/cast/place_index.h"
#include "crowdface/cast/plausibility.h"

namespace crowdface {

/// Judges a candidate by itself, whatever else is in the crowd.
class FaceJudge {
 public:
  FaceJudge(const FaceSpace& space, const DiversityOptions& diversity,
            const BelievabilityOptions& believability);

  /// What can be told from the recipe and its place, in microseconds: weights, the distance from the
  /// input heads, plausibility. \return why it will not do; nothing if it will.
  std::optional<Reason> at_a_glance(const Recipe& recipe, const FaceSpace::Place& place) const;

  PlaceIndex::Nearest nearest_head(const FaceSpace::Place& place) const {
    return heads_.nearest(place);
  }
  const FaceSpace& space() const { return space_; }
  const Plausibility& plausibility() const { return plausibility_; }

 private:
  const FaceSpace& space_;
  DiversityOptions diversity_;
  BelievabilityOptions believability_;
  PlaceIndex heads_;
  Plausibility plausibility_;
};

}  // namespace crowdface
