// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/sampling.h"

namespace crowdface {

/// Whose child a family's founder is: an input head, or a face of the plan by its id.
struct Parent {
  std::optional<Eigen::Index> head;
  std::string id;  ///< if it is no head
};

/// Faces that resemble each other.
struct FamilyOptions {
  std::string name;
  int members = 0;
  std::optional<Eigen::Index> target;  ///< of all members; none: a parent's, or drawn
  std::vector<Parent> parents;         ///< none, or mother and father
  std::vector<int> inherit;    ///< #regions: 0 from the mother, 1 from the father, −1 drawn
  double max_distance_mm = 0;  ///< from the founder, who is not in the crowd
  double min_distance_mm = 0;  ///< between members
  Range age = {0, 0};          ///< see apply_age
};

}  // namespace crowdface
