// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/blend/recipe.h"
#include "crowdface/cast/place_index.h"

namespace crowdface {

/// The faces that are settled, in the order of the plan, and where they lie.
class CrowdSoFar {
 public:
  explicit CrowdSoFar(Index dimensions) : index_(dimensions) {}

  void add(Recipe recipe, FaceSpace::Place place) {
    index_.add(place);
    recipes_.push_back(std::move(recipe));
    places_.push_back(std::move(place));
  }
  Index size() const { return index_.size(); }
  const std::vector<Recipe>& recipes() const { return recipes_; }
  const std::vector<FaceSpace::Place>& places() const { return places_; }
  const PlaceIndex& index() const { return index_; }

 private:
  std::vector<Recipe> recipes_;
  std::vector<FaceSpace::Place> places_;
  PlaceIndex index_;
};

}  // namespace crowdface
