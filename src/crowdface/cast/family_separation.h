// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/constraints.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_space.h"

namespace crowdface {

/// Keeps families apart: every member is nearer to each member of its own family than to any face
/// that is not a relative. The relatives of a member are the members of its own family, of its
/// parents' families, and of all families that have a parent in common with its own family.
class FamilySeparation {
 public:
  /// Returns whether a point is too near to a family. Each member has a radius: the distance to the
  /// family's farthest other member. The point is too near if it lies within the radius of any
  /// member.
  ///
  /// \param relatives  Names of the families that are not checked.
  bool is_too_near_to_family(const FaceSpace::Point& point,
                             const std::vector<std::string>& relatives = {}) const;
  /// Returns why a face without relatives is rejected, given the face's point in the face space;
  /// nothing if the face is accepted.
  std::optional<RejectionReason> rejection_reason(const FaceSpace::Point& stranger) const {
    return is_too_near_to_family(stranger) ? std::optional(RejectionReason::kFamily) : std::nullopt;
  }
  /// Adds a family, given by the face-space points of the family's members.
  void add(const std::string& family, const std::vector<FaceSpace::Point>& members);

 private:
  /// A member of any of the families.
  struct Member {
    std::string family;
    FaceSpace::Point point;
    /// distance from this member to the farthest member of its family
    double distance_to_farthest_member_mm;
  };
  std::vector<Member> members_;  ///< members of all families
};

/// Random faces that belong to no family. The distances from a face to these random faces show how
/// near an unrelated face can be by chance. The faces are drawn with the parameters of the crowd or
/// of a group. They depend only on the seed and on these parameters, so that a family does not
/// depend on the crowd's size. The set is empty if no family has parents.
class UnrelatedFaces {
 public:
  UnrelatedFaces(const CastingOptions& casting, const FaceSpace& space);
  /// Returns the fraction (0 … 1) of the random faces of a group (or of the crowd) whose distance
  /// from a point is below `distance_mm`.
  double fraction_nearer(const FaceSpace::Point& point, double distance_mm,
                         std::optional<std::size_t> group = std::nullopt) const;

 private:
  /// Maps the index of a group to the points of the random faces of this group. The key nullopt has
  /// the points of the faces that are drawn with the parameters of the crowd.
  std::map<std::optional<std::size_t>, std::vector<FaceSpace::Point>> points_by_group_;
};

}  // namespace crowdface
