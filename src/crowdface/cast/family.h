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
  std::optional<Eigen::Index> head;  ///< index of the head, if the parent is an input head
  std::string id;  ///< id of the face, with or without the crowd's name; or name of the head
  /// whether the parent does not exist yet, so that casting makes a face with this id
  bool is_new = false;
  /// for a new parent: index of the group that the parent belongs to; empty: no group, so the
  /// crowd's parameters apply
  std::optional<std::size_t> group = {};
  /// For a new parent that belongs to no group, the heads that may be the parent's target: the
  /// heads tagged female (mother) or male (father). Empty: all targets of the crowd.
  std::vector<Eigen::Index> possible_target_heads = {};
};

/// A family: faces that resemble each other.
struct FamilyOptions {
  std::string name;
  int member_count = 0;
  /// index of the group that the members belong to; empty: no group, so the crowd's parameters
  /// apply
  std::optional<std::size_t> group;
  /// the head that is the target of all members; empty: members inherit the target from the parents
  /// or the founder
  std::optional<Eigen::Index> target;
  std::vector<Parent> parents;  ///< the mother and the father; empty if the family has no parents
  /// one entry for each band of each region, region by region: 0 if the detail comes from the
  /// mother, 1 from the father, −1 from a random parent
  std::vector<int> parent_of_band;
  /// Largest allowed distance between a member and the founder. The founder is the face from which
  /// all members are derived; it is not in the crowd.
  double max_distance_mm = 2.5;
  double min_distance_mm = 0;  ///< smallest allowed distance between two members of the family
  /// Whether members are as similar as twins: all are within 0.5 mm of the same face. This face is
  /// not in the crowd.
  bool are_twins = false;
  AgeRange age = {};  ///< range of the members' ages
  /// limits on the members' measurements; a limit replaces the limit of the crowd or group on the
  /// same measurement
  TraitLimits traits = {};
};

}  // namespace crowdface
