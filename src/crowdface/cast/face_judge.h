// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "crowdface/cast/believability.h"
#include "crowdface/cast/diversity.h"
#include "crowdface/cast/place_index.h"
#include "crowdface/cast/plausibility.h"
#include "crowdface/cast/proxy_skin.h"

namespace crowdface {

/// Judges a candidate by itself, whatever else is in the crowd.
class FaceJudge {
 public:
  /// \param skin  judges closely; none: nothing is judged by its mesh.
  FaceJudge(const FaceSpace& space, const DiversityOptions& diversity,
            const BelievabilityOptions& believability, const ProxySkin* skin = nullptr);

  /// What can be told from the recipe and its place, in microseconds: weights, the distance from the
  /// input heads, plausibility. \return why it will not do; nothing if it will.
  std::optional<Reason> at_a_glance(const Recipe& recipe, const FaceSpace::Place& place) const;

  /// What only the shape of the skin tells, in about a millisecond: flips, stretch, intersections.
  std::optional<Reason> closely(const Recipe& recipe) const;

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
  const ProxySkin* skin_;
};

}  // namespace crowdface
