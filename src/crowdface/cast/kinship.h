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

/// What keeps families together: every member is nearer to each of its own than to anyone who is no
/// relative. Relatives are one's family, the families of one's parents, and families that share a
/// parent.
class Kinship {
 public:
  /// Whether a face would come as near to a member of a family as its own do.
  /// \param relatives  families that the face may come as near to.
  bool intrudes(const FaceSpace::Point& point,
                const std::vector<std::string>& relatives = {}) const;
  std::optional<Reason> refuses(const FaceSpace::Point& stranger) const {
    return intrudes(stranger) ? std::optional(Reason::kFamily) : std::nullopt;
  }
  /// Notes the members of a family by their places.
  void add(const std::string& family, const std::vector<FaceSpace::Point>& members);

 private:
  struct Member {
    std::string family;
    FaceSpace::Point point;
    double radius_mm;  ///< how far the farthest of its own is
  };
  std::vector<Member> members_;
};

/// Faces as sampling draws them, or the numbers of a group, whom nobody in the crowd is kin to: how near
/// strangers come by chance. A function of seed and these numbers alone, so that a family is the same
/// however large the crowd is. There are none where no family has parents.
class Strangers {
 public:
  Strangers(const Casting& casting, const FaceSpace& space);
  /// The share of those of a family's group that are nearer than `mm` to a place, 0 … 1.
  double share_nearer(const FaceSpace::Point& point, double mm,
                      std::optional<std::size_t> group = std::nullopt) const;

 private:
  std::map<std::optional<std::size_t>, std::vector<FaceSpace::Point>> of_group_;
};

}  // namespace crowdface
