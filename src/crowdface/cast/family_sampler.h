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

/// A family of the plan: its founder (from whom the members are derived), and the range of its
/// members in the crowd.
struct FamilyPlan {
  std::string name;
  FacePlan founder;  ///< the face from which the members are derived; it is not in the crowd
  FaceSpace::Point founder_point;
  /// Whether `founder` is the hidden child that all twins of the family resemble (see
  /// FamilySampler::twins_prototype). This child has the twins' age and is not in the crowd.
  bool founder_is_prototype_of_twins = false;
  Index members_begin = 0, members_end = 0;  ///< indices of the members in the crowd: [begin, end)
  /// For each child and each parent of the child, casting computes the fraction of strangers that
  /// are nearer to the child than the parent is. This is the largest of these fractions.
  double fraction_of_strangers_nearer_than_parent = 0;
};

/// Largest allowed FamilySampler::fraction_of_strangers_nearer_than_parent of a family's founder.
/// The founder is the mean of both parents. The limit for children is larger, so that children can
/// differ from the founder.
inline constexpr double kMaxFractionOfNearerStrangersForFounder = 0.06;

/// Makes random faces of one family. Each member lies between the founder and a random face. The
/// member's distance from the founder is random, and at most max_distance.
class FamilySampler {
 public:
  /// \param crowd  All faces except the members of this family. Parents are found among these faces
  ///               by id.
  FamilySampler(const CastingOptions& casting, const FamilyOptions& family, const FaceJudge& judge,
                const UnrelatedFaces& unrelated, const CrowdSoFar& crowd);

  /// Returns whether new parents must be made for this family because some parents are not in the
  /// crowd yet.
  bool needs_parents() const { return !parents_not_in_crowd_.empty(); }
  /// Makes the missing parents; see needs_parents().
  ///
  /// \return  false if there is no room for these parents in the crowd.
  bool sample_parents(const CrowdSoFar& crowd, const FamilySeparation& family_separation,
                      std::uint32_t attempt, RejectionCounts& rejections);
  /// Returns the parents that the last call of sample_parents made, mother first.
  const std::vector<FaceSearch::FoundFace>& new_parents() const { return new_parents_; }
  /// Returns the distance from a point to the nearest new parent. (New parents are not yet in the
  /// crowd, so the crowd's search does not find them.)
  double distance_to_new_parent_mm(const FaceSpace::Point& point) const;

  /// Returns the face from which all members start: the mean of both parents or, without parents, a
  /// random face.
  FacePlan founder(std::uint32_t attempt) const;
  /// Returns the hidden child that all twins resemble. Sets FacePlan::age of the returned face, but
  /// does not change the face's recipe to show this age.
  FacePlan twins_prototype(const FamilyPlan& family_plan, std::uint32_t attempt) const;
  /// Returns candidate number `attempt` for member number `member`; members count from 1.
  FacePlan member(const FamilyPlan& family_plan, int member, std::uint32_t attempt) const;

  /// Returns why a face is rejected as a member of this family, given the face's point; nothing if
  /// the face is accepted.
  ///
  /// \param members  Points of the members found so far.
  std::optional<RejectionReason> rejection_reason(const FamilyPlan& family_plan,
                                                  const FaceSpace::Point& point,
                                                  const std::vector<FaceSpace::Point>& members,
                                                  const FamilySeparation& family_separation) const;

  /// For each parent, computes the fraction of strangers that are nearer to the point than the
  /// parent is. Returns the larger fraction. For a family in a group, the strangers are faces of
  /// this group, and a parent is considered only if all heads of the parent are in the group.
  double fraction_of_strangers_nearer_than_parent(const FaceSpace::Point& point) const;

 private:
  /// A parent whose plan is known: an input head, or a face of the crowd or of `new_parents_`.
  struct KnownParent {
    std::string name;  ///< name of the parent's head, or id of the parent's face
    /// The parent's plan without the effects of the parent's age. If the parent is an input head,
    /// only the plan's target is set.
    FacePlan face;
    FaceSpace::Point point;
  };
  /// The random face of one member, the member's age, and the member's distance from the founder.
  struct MemberDraft {
    FacePlan random_face;
    Age age;
    /// for twins: the age of their prototype in years, if this age was given in years
    std::optional<double> age_years_of_twins = {};
    double distance_mm = 0;  ///< distance of the member from the founder
  };

  /// Stores a parent in `parents_`, without the effects of the parent's age.
  void add_parent(std::size_t parent, std::string name, FacePlan face, FaceSpace::Point point);
  /// Sets `third_contributor_distribution_`, `target_substitutes_` and `source_substitutes_`.
  /// Called when the parents are known.
  void prepare_inheritance();
  /// Returns a parent's coarse shape as weights of heads. Each head outside the family's group is
  /// replaced by a similar head of the group.
  std::vector<SourceWeight> coarse_shape_of(std::size_t parent) const;
  /// Returns the distribution of the third contributor, who provides what members inherit from
  /// neither parent. The third contributor is a random mixture of heads that share the most tags
  /// with both parents (at least three heads, if there are as many), so that a child's skin tone
  /// stays plausible.
  FaceDistribution third_contributor_distribution() const;
  /// Returns the band of detail that a parent passes on: the band of the parent's recipe or, if the
  /// parent is an input head, the head's own detail. Each head outside the family's group is
  /// replaced by a similar head of the group.
  BandRecipe parent_band(std::size_t parent, std::size_t region, std::size_t band,
                         const BandRecipe& random_band) const;
  /// Returns the parent from whom all members inherit this band of this region: 0 for the mother, 1
  /// for the father, −1 for a parent drawn at random for each member.
  int parent_to_inherit_from(std::size_t region, std::size_t band) const;
  /// Mixes the coarse shape of a face with the coarse shapes of both parents, and each band of each
  /// region with the same band of one parent.
  void inherit_from_parents(FacePlan& face, const FaceRandomKey& key) const;
  /// Draws the random values of candidate number `attempt` for a member.
  MemberDraft member_draft(const FamilyPlan& family_plan, int member, std::uint32_t attempt) const;
  /// Returns (1 − t)·from + t·draft.random_face, with the age of the draft applied.
  FacePlan mixed_face(const FacePlan& from, const MemberDraft& draft, double t) const;
  /// Returns a mixture of the founder and the random face. The mixture has the distance from the
  /// founder that the draft specifies.
  FacePlan face_at_chosen_distance(const FamilyPlan& family_plan, const MemberDraft& draft) const;
  double max_distance_from_founder_mm(const FamilyPlan& family_plan) const;
  /// Returns whether a child resembles the parents. If the parents are far apart, not even the
  /// founder (their mean) resembles both parents. Then a child is accepted if its distance from
  /// each parent is not much larger than the founder's distance from this parent.
  bool resembles_parents(const FamilyPlan& family_plan, const FaceSpace::Point& point) const;

  const CastingOptions& casting_;
  const FamilyOptions& family_;
  const FaceJudge& judge_;
  const UnrelatedFaces& unrelated_faces_;
  /// one entry per parent; the entry of a missing parent is empty
  std::vector<KnownParent> parents_;
  /// indices in `parents_` of the parents that are not in the crowd yet
  std::vector<std::size_t> parents_not_in_crowd_;
  /// parents that the last call of sample_parents made
  std::vector<FaceSearch::FoundFace> new_parents_;
  /// Distribution of the third contributor: a random face from which members inherit what they
  /// inherit from neither parent.
  FaceDistribution third_contributor_distribution_;
  /// maps each target head of a parent to a similar target head of the family's group
  SubstituteHeads target_substitutes_;
  /// For each band: which head of the family's group replaces a head that lends detail to a parent
  /// but is not in the group. Empty if the family has no group or no parents.
  std::vector<SubstituteHeads> source_substitutes_;
  /// Names of the families related to this family: families that have a parent of this family as a
  /// member, and families that have a parent in common with this family.
  std::vector<std::string> relative_family_names_;
  /// points of relatives (kin) and of all other faces (strangers)
  NearestFaceSearch relative_points_, stranger_points_;
};

}  // namespace crowdface
