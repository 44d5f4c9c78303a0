// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/cast/place_index.h"

namespace crowdface {

/// The faces that are settled, in the order of the plan, and where they lie.
class CrowdSoFar {
 public:
  explicit CrowdSoFar(Index dimensions) : index_(dimensions) {}

  void add(CastFace face, FaceSpace::Place place) {
    index_.add(place);
    faces_.push_back(std::move(face));
    places_.push_back(std::move(place));
  }
  Index size() const { return index_.size(); }
  /// What comes from now on is sampled.
  void begin_sampled() { first_sampled_ = size(); }
  /// Candidates compete by their distance from the faces from here on, so that a recipe or a family
  /// more does not change which of them wins (though all faces must be far enough from all).
  Index first_sampled() const { return first_sampled_; }
  const std::vector<CastFace>& faces() const { return faces_; }
  const std::vector<FaceSpace::Place>& places() const { return places_; }
  const PlaceIndex& index() const { return index_; }

 private:
  std::vector<CastFace> faces_;
  std::vector<FaceSpace::Place> places_;
  PlaceIndex index_;
  Index first_sampled_ = 0;
};

}  // namespace crowdface
