// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/crowd_so_far.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_search.h"
#include "crowdface/cast/family_separation.h"
#include "crowdface/cast/substitute_heads.h"

namespace crowdface {

/// A family of the plan: its founder, and the range of its members in the crowd.
struct FamilyPlan {
  std::string name;
  FacePlan founder;  ///< not in the crowd
  FaceSpace::Point founder_point;
  /// twins: the founder is a hidden child, whose age the twins have
  bool alike_to_founder = false;
  Index begin = 0, end = 0;     ///< range of its members in the crowd
  double strangers_nearer = 0;  ///< largest fraction of strangers nearer to a child than a parent
};

/// Limit for the fraction of strangers that are nearer than a parent to the mean of both parents.
/// It is smaller than the corresponding limit for children, so that children have room to differ.
inline constexpr double kStrangersNearerToHalf = 0.06;

/// Draws the faces of one family. Each member lies between the founder and a random face, at a
/// random distance from the founder of at most max_distance.
class FamilyDraws {
 public:
  /// \param crowd  All faces except the family; parents are looked up in it by id.
  FamilyDraws(const CastingOptions& casting, const FamilyOptions& family, const FaceJudge& judge,
              const UnrelatedFaces& unrelated, const CrowdSoFar& crowd);

  /// Returns whether parents must be drawn for this family because they are not in the crowd yet.
  bool needs_parents() const { return !to_draw_.empty(); }
  /// Draws the parents of needs_parents().
  ///
  /// \return  false if there is no room for them in the crowd.
  bool draw_parents(const CrowdSoFar& crowd, const FamilySeparation& family_separation,
                    std::uint32_t attempt, Rejections& rejections);
  /// Returns the parents drawn last, mother first.
  const std::vector<FaceSearch::Found>& drawn_parents() const { return drawn_; }
  /// Returns the distance to the nearest drawn parent; drawn parents are not in the crowd yet.
  double drawn_parent_mm(const FaceSpace::Point& point) const;

  /// Draws the founder, from whom all members start: with parents, the mean of both; otherwise a
  /// sampled face.
  FacePlan founder(std::uint32_t attempt) const;
  /// Draws the hidden child that all twins resemble. Its age is stored but not applied.
  FacePlan model_of_twins(const FamilyPlan& cast, std::uint32_t attempt) const;
  /// Draws member number `member`, from 1.
  FacePlan member(const FamilyPlan& cast, int member, std::uint32_t attempt) const;

  /// Returns why a point is rejected for a member of this family, nothing if it is accepted.
  ///
  /// \param own  Points of the members found so far.
  std::optional<Reason> refuses(const FamilyPlan& cast, const FaceSpace::Point& point,
                                const std::vector<FaceSpace::Point>& own,
                                const FamilySeparation& family_separation) const;

  /// Returns the largest fraction, over both parents, of strangers that are nearer to a point than
  /// the parent. For a family in a group, strangers are drawn from this group, and only parents
  /// whose heads are all in the group are considered.
  double strangers_nearer(const FaceSpace::Point& point) const;

 private:
  struct KnownParent {
    std::string name;  ///< name of the head, or id of the face
    FacePlan face;     ///< the parent, without its age; for a head, only the target is set
    FaceSpace::Point point;
  };
  /// The random face, age and distance from the founder of one member.
  struct Draft {
    FacePlan to;
    double age = 0, reach_mm = 0;
  };

  void add_parent(std::size_t parent, std::string name, FacePlan face, FaceSpace::Point point);
  void meet_parents();
  std::vector<SourceWeight> form_of(std::size_t parent) const;
  FaceKind third_contributor() const;
  const SamplingOptions& sampling_of(const FacePlan& face) const;
  BandRecipe of_parent(std::size_t parent, std::size_t region, std::size_t band,
                       const BandRecipe& drawn) const;
  int inherited_from(std::size_t region, std::size_t band) const;
  void inherit(FacePlan& face, const DrawKey& key) const;
  Draft draft(const FamilyPlan& cast, int member, std::uint32_t attempt) const;
  FacePlan towards(const FacePlan& from, const Draft& draft, double t) const;
  FacePlan at_drawn_distance(const FamilyPlan& cast, const Draft& draft) const;
  double reach_mm(const FamilyPlan& cast) const;
  bool resembles_parents(const FamilyPlan& cast, const FaceSpace::Point& point) const;

  const CastingOptions& casting_;
  const FamilyOptions& family_;
  const FaceJudge& judge_;
  const UnrelatedFaces& unrelated_;
  std::vector<KnownParent> parents_;  ///< #parents; empty entries are still to be drawn
  std::vector<std::size_t> to_draw_;  ///< indices of parents that were not in the crowd
  std::vector<FaceSearch::Found> drawn_;
  FaceKind others_;  ///< parameters for what members inherit from neither parent
  /// replaces targets of the parents by targets of the family's group
  SubstituteHeads form_;
  /// by band: replaces the parents' sources by sources of the group; empty: no group
  std::vector<SubstituteHeads> detail_;
  /// families of the parents, and families that share a parent
  std::vector<std::string> relatives_;
  FacePointIndex kin_, strangers_;  ///< points of relatives, and of all other faces
};

/// Returns "NAME_FAMILY_01".
std::string member_id(const std::string& crowd, const std::string& family, int member);

/// Returns the full id of a parent drawn for a family: "NAME_FAMILY_mother".
std::string parent_id(const std::string& crowd, const Parent& parent);

}  // namespace crowdface
