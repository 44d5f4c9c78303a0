// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/sampling.h"

namespace crowdface {

/// Whose child a family's founder is: an input head, or a face of the plan by its id.
struct Parent {
  std::optional<Eigen::Index> head;
  std::string id;      ///< with or without the crowd's name; a head's name, if it is one
  bool drawn = false;  ///< cast for this family, as a face of the crowd of that id
  std::optional<std::size_t> group =
      {};  ///< of one who is drawn: by whose numbers; none: the crowd's
  /// Of one who is drawn by the crowd's numbers: the heads of a woman or a man, as far as it is known of
  /// any; none: all that the crowd's faces stand on.
  std::vector<Eigen::Index> targets = {};
};

/// Faces that resemble each other.
struct FamilyOptions {
  std::string name;
  int members = 0;
  std::optional<std::size_t> group;    ///< by whose numbers they are drawn; none: the crowd's
  std::optional<Eigen::Index> target;  ///< of all members; none: inherited, or the founder's
  std::vector<Parent> parents;         ///< none, or mother and father
  /// #regions by #bands, region by region: 0 from the mother, 1 from the father, −1 drawn
  std::vector<int> inherit;
  double max_distance_mm = 2.5;  ///< from the founder, who is not in the crowd
  double min_distance_mm = 0;    ///< between members
  bool twins = false;            ///< as alike as twins: within half a millimetre of a hidden child
  Range age = {0, 0};            ///< see apply_age
};

}  // namespace crowdface
