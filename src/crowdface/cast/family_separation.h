// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_space.h"

namespace crowdface {

/// Keeps families together: every member is nearer to each member of its family than to anyone who
/// is not a relative. Relatives are the own family, the parents' families, and families that share
/// a parent.
class FamilySeparation {
 public:
  /// Returns whether a face would be as near to a member of a family as the farthest of its family.
  ///
  /// \param relatives  Families that are not checked.
  bool intrudes(const FaceSpace::Point& point,
                const std::vector<std::string>& relatives = {}) const;
  std::optional<Reason> refuses(const FaceSpace::Point& stranger) const {
    return intrudes(stranger) ? std::optional(Reason::kFamily) : std::nullopt;
  }
  /// Adds the members of a family.
  void add(const std::string& family, const std::vector<FaceSpace::Point>& members);

 private:
  struct Member {
    std::string family;
    FaceSpace::Point point;
    double radius_mm;  ///< distance to the farthest member of the same family
  };
  std::vector<Member> members_;
};

/// Faces drawn with the crowd's or a group's parameters that are related to nobody: they tell how
/// near strangers are by chance. A function of the seed and these parameters only, so that a family
/// does not depend on the crowd's size. Empty if no family has parents.
class UnrelatedFaces {
 public:
  UnrelatedFaces(const CastingOptions& casting, const FaceSpace& space);
  /// Returns the fraction of a group's strangers that are nearer than `mm` to a point, 0 … 1.
  double share_nearer(const FaceSpace::Point& point, double mm,
                      std::optional<std::size_t> group = std::nullopt) const;

 private:
  std::map<std::optional<std::size_t>, std::vector<FaceSpace::Point>> of_group_;
};

}  // namespace crowdface
