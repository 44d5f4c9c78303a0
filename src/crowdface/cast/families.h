// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/crowd_so_far.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_search.h"

namespace crowdface {

/// A family that was cast.
struct FamilyCast {
  std::string name;
  CastFace founder;  ///< not in the crowd
  FaceSpace::Point founder_point;
  Index begin = 0, end = 0;  ///< its members in the crowd
};

/// What keeps families together: every member is nearer to each of its own than to anyone who is no
/// relative. Relatives are one's family and the families of one's parents.
class Kinship {
 public:
  /// Whether a face would come as near to a member of a family as its own do.
  /// \param relatives  families that the face may come as near to.
  bool intrudes(const FaceSpace::Point& point,
                const std::vector<std::string>& relatives = {}) const;
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

/// Draws the members of one family: each on the way from the founder to a face drawn at random, as
/// far as max_distance lets it go.
class FamilyDraws {
 public:
  /// \param crowd  everyone but the family: where parents are looked up by id.
  FamilyDraws(const Casting& casting, const FamilyOptions& family, const FaceJudge& judge,
              const CrowdSoFar& crowd);

  /// The founder: the parents' regions where there are parents, else a face like any other.
  CastFace founder(std::uint32_t attempt) const;
  /// Member number `member`, from 1.
  CastFace member(const FamilyCast& cast, int member, std::uint32_t attempt) const;

  /// Whether a place will not do for a member beside these others of its family.
  bool refuses(const FamilyCast& cast, const FaceSpace::Point& point,
               const std::vector<FaceSpace::Point>& own, const Kinship& kinship) const;

 private:
  RegionRecipe of_parent(std::size_t parent, std::size_t region, const RegionRecipe& drawn) const;
  CastFace towards(const Recipe& from, const CastFace& to, double t, double age) const;

  const Casting& casting_;
  const FamilyOptions& family_;
  const FaceJudge& judge_;
  std::vector<CastFace> parents_;       ///< those of parents that are faces; for a head its target
  std::vector<std::string> relatives_;  ///< the families of parents
  FacePointIndex kin_, strangers_;      ///< relatives, and everyone else
};

/// "NAME_FAMILY_01".
std::string member_id(const std::string& crowd, const std::string& family, int member);

/// Casts one family and adds its members to the crowd. Where a founder has no room for all of them
/// another one is drawn, a bounded number of times.
/// \return nothing if it cannot be cast; `rejections` says why.
std::optional<FamilyCast> cast_family(const Casting& casting, const FamilyOptions& family,
                                      const FaceJudge& judge, CrowdSoFar& crowd, Kinship& kinship,
                                      Rejections& rejections);

/// Mean silhouette of a family's members (Rousseeuw 1987): (b − a)/max(a, b), a being the mean
/// distance to one's own, b that to the nearest other family (to everyone else, if it is the only
/// one). 1: far from all others; below 0: nearer to others.
double silhouette(const std::vector<FamilyCast>& families, std::size_t family,
                  const std::vector<FaceSpace::Point>& points);

}  // namespace crowdface
