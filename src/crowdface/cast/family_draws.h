// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/crowd_so_far.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_search.h"
#include "crowdface/cast/kinship.h"
#include "crowdface/cast/stand_ins.h"

namespace crowdface {

/// A family that was cast.
struct FamilyCast {
  std::string name;
  CastFace founder;  ///< not in the crowd
  FaceSpace::Point founder_point;
  bool alike_to_founder = false;  ///< twins: the founder is a hidden child, of their age too
  Index begin = 0, end = 0;       ///< its members in the crowd
  double strangers_nearer = 0;  ///< the largest share of strangers nearer to a child than a parent
};

/// Half of either parent must leave room for children to differ: no larger a share of strangers may be
/// nearer to it than a parent.
inline constexpr double kStrangersNearerToHalf = 0.06;

/// Draws the faces of one family: each child on the way from the founder to a face drawn at random,
/// as far as max_distance lets it go.
class FamilyDraws {
 public:
  /// \param crowd  everyone but the family: where parents are looked up by id.
  FamilyDraws(const Casting& casting, const FamilyOptions& family, const FaceJudge& judge,
              const Strangers& unrelated, const CrowdSoFar& crowd);

  /// Whether there are parents to be drawn for this family, who are not in the crowd yet.
  bool wants_parents() const { return !to_draw_.empty(); }
  /// Draws them. \return false if there is no room for them.
  bool draw_parents(const CrowdSoFar& crowd, const Kinship& kinship, std::uint32_t attempt,
                    Rejections& rejections);
  /// Those that were drawn, mother first.
  const std::vector<FaceSearch::Found>& drawn_parents() const { return drawn_; }
  /// How far the nearest of these is, who are not in the crowd yet.
  double drawn_parent_mm(const FaceSpace::Point& point) const;

  /// What all members start from: half of either parent where there are parents, else a face like any
  /// other.
  CastFace founder(std::uint32_t attempt) const;
  /// The hidden child that all twins are near to; its age is noted, but not applied.
  CastFace model_of_twins(const FamilyCast& cast, std::uint32_t attempt) const;
  /// Member number `member`, from 1.
  CastFace member(const FamilyCast& cast, int member, std::uint32_t attempt) const;

  /// Why a place will not do for a member beside these others of its family; nothing if it will.
  std::optional<Reason> refuses(const FamilyCast& cast, const FaceSpace::Point& point,
                                const std::vector<FaceSpace::Point>& own,
                                const Kinship& kinship) const;

  /// The largest share of strangers that are nearer to a place than one of the parents; of a family of a
  /// group strangers and parents of this group alone.
  double strangers_nearer(const FaceSpace::Point& point) const;

 private:
  struct KnownParent {
    std::string name;  ///< of the head, or the face's id
    CastFace face;     ///< without its age; of a head only its target
    FaceSpace::Point point;
  };
  /// What one member tends to, of what age it is and how far from the founder.
  struct Draft {
    CastFace to;
    double age = 0, reach_mm = 0;
  };

  void know(std::size_t parent, std::string name, CastFace face, FaceSpace::Point point);
  void meet_parents();
  std::vector<SourceWeight> form_of(std::size_t parent) const;
  FaceKind somebody_else() const;
  const SamplingOptions& sampling_of(const CastFace& face) const;
  BandRecipe of_parent(std::size_t parent, std::size_t region, std::size_t band,
                       const BandRecipe& drawn) const;
  int inherited_from(std::size_t region, std::size_t band) const;
  void inherit(CastFace& face, const DrawKey& key) const;
  Draft draft(const FamilyCast& cast, int member, std::uint32_t attempt) const;
  CastFace towards(const CastFace& from, const Draft& draft, double t) const;
  CastFace as_far_as_drawn(const FamilyCast& cast, const Draft& draft) const;
  double reach_mm(const FamilyCast& cast) const;
  bool takes_after_parents(const FamilyCast& cast, const FaceSpace::Point& point) const;

  const Casting& casting_;
  const FamilyOptions& family_;
  const FaceJudge& judge_;
  const Strangers& unrelated_;
  std::vector<KnownParent> parents_;  ///< #parents; empty ones are still to be drawn
  std::vector<std::size_t> to_draw_;  ///< parents who were not in the crowd
  std::vector<FaceSearch::Found> drawn_;
  FaceKind others_;                     ///< from whom members have what is no parent's
  StandIns form_;                       ///< of parents, among the targets of the family's group
  std::vector<StandIns> detail_;        ///< by bands, among who lends to these; empty: no group
  std::vector<std::string> relatives_;  ///< families of parents, and families that share one
  FacePointIndex kin_, strangers_;      ///< relatives, and everyone else
};

/// "NAME_FAMILY_01".
std::string member_id(const std::string& crowd, const std::string& family, int member);

/// The full id of a parent that is drawn for a family: "NAME_FAMILY_mother".
std::string parent_id(const std::string& crowd, const Parent& parent);

}  // namespace crowdface
