// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "crowdface/cast/constraints.h"
#include "crowdface/cast/nearest_face_search.h"
#include "crowdface/cast/plausibility.h"
#include "crowdface/cast/proxy_skin.h"
#include "crowdface/cast/trait_rules.h"
#include "crowdface/validity/skin_check.h"

namespace crowdface {

/// Returns the first limit that the defects of a face's skin exceed; nothing if they exceed no
/// limit.
std::optional<RejectionReason> exceeded_limit(const BelievabilityOptions& limits,
                                              const SkinDefects& defects);

/// Builds the whole mesh of a recipe, and compares the mesh's skin with the target's skin. Must be
/// callable from any thread.
using MeshDefectFinder = std::function<SkinDefects(const Recipe&)>;

/// Judges one candidate at a time, without regard to the other faces of the crowd.
class FaceJudge {
 public:
  /// \param proxy_skin         Coarse mesh on which flips and intersections are checked. Null: no
  ///                           check of the skin.
  /// \param find_mesh_defects  If given, FaceJudge also checks whole meshes of the candidates that
  ///                           pass the coarse check.
  FaceJudge(const FaceSpace& space, const DiversityOptions& diversity,
            const BelievabilityOptions& believability, const ProxySkin* proxy_skin = nullptr,
            MeshDefectFinder find_mesh_defects = {});

  /// Sets the limits on measurements. Nothing: no limits.
  void set_trait_rules(std::optional<TraitRules> rules) { trait_rules_ = rules; }
  const TraitRules* trait_rules() const { return trait_rules_ ? &*trait_rules_ : nullptr; }
  void set_diversity(const DiversityOptions& diversity) { diversity_ = diversity; }
  /// Returns whether this judge checks whole meshes.
  bool checks_meshes() const { return find_mesh_defects_ != nullptr; }
  /// From now on, check_skin checks only the coarse mesh.
  void stop_mesh_checks() { find_mesh_defects_ = nullptr; }
  /// Returns the positions of a face's landmarks, see FaceMeasurer::landmarks. Takes microseconds.
  /// Returns no rows if there are neither limits on measurements nor distributions of measurements.
  Positions landmarks(const Recipe& recipe) const;
  /// Checks whether a face meets the limits on its measurements, given the positions of the face's
  /// landmarks.
  std::optional<RejectionReason> check_traits(const FacePlan& face,
                                              const Positions& landmarks) const;
  /// Like the overload with `landmarks`, but takes the positions of the landmarks from the face's
  /// whole mesh. Takes about a millisecond.
  std::optional<RejectionReason> check_traits(const FacePlan& face) const;

  /// Checks everything that needs only the recipe and the face's point in the face space: weights,
  /// distance from the input heads, plausibility. Takes microseconds.
  ///
  /// \return  Why the candidate is rejected; nothing if it is accepted.
  std::optional<RejectionReason> check_recipe(const Recipe& recipe,
                                              const FaceSpace::Point& point) const;

  /// Like `check_recipe`. The first DiversityOptions::kCandidatesCheckedForSamePerson candidates of
  /// a face are also rejected if they count as the same person as a head.
  ///
  /// \param earlier_candidate_count  Number of earlier candidates for the same face.
  std::optional<RejectionReason> check_candidate(const Recipe& recipe,
                                                 const FaceSpace::Point& point,
                                                 std::uint32_t earlier_candidate_count) const;

  /// Checks the form of the skin: flips, stretch, intersections. Takes a millisecond on the coarse
  /// mesh, a tenth of a second on a whole mesh of 28,000 triangles.
  ///
  /// \return  Why the candidate is rejected; nothing if it is accepted.
  std::optional<RejectionReason> check_skin(const Recipe& recipe) const;

  /// Returns the head nearest to a point. If faces may be mirrored, the mirror image of a head
  /// counts as this head.
  NearestFaceSearch::NearestFace nearest_head(const FaceSpace::Point& point) const {
    NearestFaceSearch::NearestFace nearest = head_search_.nearest(point);
    nearest.face %= space_.head_count();
    return nearest;
  }
  const FaceSpace& space() const { return space_; }

 private:
  const FaceSpace& space_;
  DiversityOptions diversity_;
  BelievabilityOptions believability_;
  NearestFaceSearch head_search_;  ///< finds heads (and mirror images of heads) near a point
  /// a face that is nearer to a head than this distance counts as the same person as the head
  double same_person_mm_;
  Plausibility plausibility_;
  const ProxySkin* proxy_skin_;         ///< coarse mesh; null: no check of the skin
  MeshDefectFinder find_mesh_defects_;  ///< null: whole meshes are not checked
  std::optional<TraitRules> trait_rules_;
};

}  // namespace crowdface
