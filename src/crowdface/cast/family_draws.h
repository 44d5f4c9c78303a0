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
  /// whether the members are twins: then the founder is a hidden child of the same age as the twins
  bool has_twin_model = false;
  Index begin = 0, end = 0;  ///< range of the members in the crowd
  /// largest fraction of strangers nearer to a child than its parent
  double nearer_strangers_fraction = 0;
};

/// Largest fraction of strangers that may be nearer to the mean of both parents than a parent is.
/// It is smaller than the corresponding limit for children, so that children can differ from that
/// mean.
inline constexpr double kMaxNearerStrangersToMean = 0.06;

/// Makes random faces of one family. Each member lies between the founder and a random face, at a
/// random distance of at most max_distance from the founder.
class FamilySampler {
 public:
  /// \param crowd  All faces except the family, among them the parents, found by id.
  FamilySampler(const CastingOptions& casting, const FamilyOptions& family, const FaceJudge& judge,
                const UnrelatedFaces& unrelated, const CrowdSoFar& crowd);

  /// Returns whether new parents must be made for this family because they are not in the crowd
  /// yet.
  bool needs_parents() const { return !missing_parents_.empty(); }
  /// Makes the missing parents; see needs_parents().
  ///
  /// \return  false if there is no room for these parents in the crowd.
  bool sample_parents(const CrowdSoFar& crowd, const FamilySeparation& family_separation,
                      std::uint32_t attempt, Rejections& rejections);
  /// Returns the parents that the last call of sample_parents made, mother first.
  const std::vector<FaceSearch::Found>& new_parents() const { return new_parents_; }
  /// Returns the distance from a point to the nearest new parent. New parents are not yet in the
  /// crowd.
  double distance_to_new_parent_mm(const FaceSpace::Point& point) const;

  /// Returns the founder, from whom all members start: with parents, the mean of both parents;
  /// otherwise a random face.
  FacePlan founder(std::uint32_t attempt) const;
  /// Returns the hidden child that all twins resemble. The child's age is stored but not applied.
  FacePlan twin_model(const FamilyPlan& cast, std::uint32_t attempt) const;
  /// Returns candidate number `attempt` for member number `member`, which counts from 1.
  FacePlan member(const FamilyPlan& cast, int member, std::uint32_t attempt) const;

  /// Returns why a point is rejected for a member of this family, nothing if it is accepted.
  ///
  /// \param members  Points of the members found so far.
  std::optional<Reason> rejection_reason(const FamilyPlan& cast, const FaceSpace::Point& point,
                                         const std::vector<FaceSpace::Point>& members,
                                         const FamilySeparation& family_separation) const;

  /// For each parent, computes the fraction of strangers that are nearer to the point than the
  /// parent is. Returns the larger fraction. For a family in a group, strangers are of this group,
  /// and only parents whose heads are all in the group are considered.
  double nearer_strangers_fraction(const FaceSpace::Point& point) const;

 private:
  struct KnownParent {
    std::string name;  ///< name of the head, or id of the face
    FacePlan face;     ///< the parent, without its age; for a head, only the target is set
    FaceSpace::Point point;
  };
  /// The random face, age and distance from the founder of one member.
  struct Draft {
    FacePlan random_face;
    double age = 0, distance_mm = 0;
  };

  void add_parent(std::size_t parent, std::string name, FacePlan face, FaceSpace::Point point);
  void prepare_inheritance();
  std::vector<SourceWeight> coarse_shape_of(std::size_t parent) const;
  FaceKind third_contributor() const;
  const SamplingOptions& sampling_of(const FacePlan& face) const;
  BandRecipe parent_band(std::size_t parent, std::size_t region, std::size_t band,
                         const BandRecipe& random_band) const;
  int inherited_parent(std::size_t region, std::size_t band) const;
  void inherit_from_parents(FacePlan& face, const FaceRandomKey& key) const;
  Draft draft(const FamilyPlan& cast, int member, std::uint32_t attempt) const;
  FacePlan mixed_face(const FacePlan& from, const Draft& draft, double t) const;
  FacePlan face_at_chosen_distance(const FamilyPlan& cast, const Draft& draft) const;
  double max_reach_mm(const FamilyPlan& cast) const;
  bool resembles_parents(const FamilyPlan& cast, const FaceSpace::Point& point) const;

  const CastingOptions& casting_;
  const FamilyOptions& family_;
  const FaceJudge& judge_;
  const UnrelatedFaces& unrelated_;
  std::vector<KnownParent> parents_;          ///< #parents; entries of missing parents are empty
  std::vector<std::size_t> missing_parents_;  ///< indices of parents that were not in the crowd
  std::vector<FaceSearch::Found> new_parents_;
  FaceKind contributor_kind_;  ///< parameters of features that members inherit from neither parent
  /// replaces targets of the parents by targets of the family's group
  SubstituteHeads target_substitutes_;
  /// by band: replaces the parents' sources by sources of the group; empty: no group
  std::vector<SubstituteHeads> source_substitutes_;
  /// families of the parents, and families that share a parent
  std::vector<std::string> relatives_;
  NearestFaceSearch kin_points_, stranger_points_;  ///< points of relatives, and of all other faces
};

/// Returns the id of a family's member, such as "NAME_FAMILY_01".
std::string member_id(const std::string& crowd, const std::string& family, int member);

/// Returns the full id of a new parent of a family: "NAME_FAMILY_mother".
std::string parent_id(const std::string& crowd, const Parent& parent);

}  // namespace crowdface
