// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/sampling.h"

namespace crowdface {

/// A parent of a family: an input head, or a face of the plan, given by its id.
struct Parent {
  std::optional<Eigen::Index> head;
  std::string id;       ///< id of the face, with or without the crowd's name; or name of the head
  bool is_new = false;  ///< the parent does not exist yet: casting makes a face with this id
  /// new parent: group whose parameters are used; empty: the crowd's parameters
  std::optional<std::size_t> group = {};
  /// Possible targets of a new parent outside all groups: the heads tagged female or male. Empty:
  /// all targets of the crowd.
  std::vector<Eigen::Index> targets = {};
};

/// A family: faces that resemble each other.
struct FamilyOptions {
  std::string name;
  int members = 0;
  std::optional<std::size_t>
      group;  ///< group whose parameters are used; empty: the crowd's parameters
  /// target of all members; empty: the target is inherited from the parents or the founder
  std::optional<Eigen::Index> target;
  std::vector<Parent> parents;  ///< empty, or mother and father
  /// #regions by #bands, region by region: 0 from the mother, 1 from the father, −1 from neither
  std::vector<int> inherited_parents;
  /// largest distance of a member from the founder, who is not in the crowd
  double max_distance_mm = 2.5;
  double min_distance_mm = 0;  ///< smallest distance between members
  /// members are as similar as twins: within 0.5 mm of a common face that is not in the crowd
  bool twins = false;
  Range age = {0, 0};       ///< ages of the members, see apply_age
  TraitLimits traits = {};  ///< replace the crowd's or group's limits on the same traits
};

}  // namespace crowdface
