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

/// Returns the first limit that a face's skin exceeds; nothing if it exceeds none.
std::optional<Reason> exceeded_limit(const BelievabilityOptions& limits, const SkinDefects& skin);

/// Builds the whole mesh of a recipe and compares its skin with the target's. Must be callable from
/// any thread.
using FindMeshDefects = std::function<SkinDefects(const Recipe&)>;

/// Judges single candidates, independently of the crowd.
class FaceJudge {
 public:
  /// \param skin    Coarse mesh on which flips and intersections are checked. Null: no such check.
  /// \param meshes  If given, also checks whole meshes of candidates that pass the coarse check.
  FaceJudge(const FaceSpace& space, const DiversityOptions& diversity,
            const BelievabilityOptions& believability, const ProxySkin* skin = nullptr,
            FindMeshDefects meshes = {});

  /// Sets limits on measurements. \param rules  must outlive this object; null: no limits
  void set_trait_rules(const TraitRules* rules) { traits_ = rules; }
  const TraitRules* traits() const { return traits_; }
  /// Checks the limits on measurements; takes the landmarks from the whole mesh.
  std::optional<Reason> check_traits(const FacePlan& face) const;

  /// Checks in microseconds everything that follows from a recipe and its point: weights, distance
  /// from the input heads, plausibility.
  ///
  /// \return  Why the candidate is rejected; nothing if it is accepted.
  std::optional<Reason> check_recipe(const Recipe& recipe, const FaceSpace::Point& point) const;

  /// Like `check_recipe`. Also rejects the first candidates for a face if they pass for a head; see
  /// DiversityOptions::kCandidatesUnlikeHeads.
  ///
  /// \param earlier  Number of earlier candidates for the same face.
  std::optional<Reason> check_candidate(const Recipe& recipe, const FaceSpace::Point& point,
                                        std::uint32_t earlier) const;

  /// Checks the shape of the skin: flips, stretch, intersections. Takes a millisecond on the
  /// samples, a tenth of a second on a mesh of 28,000 triangles.
  ///
  /// \return  Why the candidate is rejected; nothing if it is accepted.
  std::optional<Reason> check_skin(const Recipe& recipe) const;

  /// Returns the nearest head. If faces may be mirrored, mirror images of heads count as the head.
  NearestFaceSearch::NearestFace nearest_head(const FaceSpace::Point& point) const {
    NearestFaceSearch::NearestFace nearest = heads_.nearest(point);
    nearest.face %= space_.head_count();
    return nearest;
  }
  const FaceSpace& space() const { return space_; }

 private:
  const FaceSpace& space_;
  DiversityOptions diversity_;
  BelievabilityOptions believability_;
  NearestFaceSearch heads_;
  double same_person_mm_;  ///< below this distance from a head, a face passes for the head
  Plausibility plausibility_;
  const ProxySkin* skin_;
  FindMeshDefects mesh_defects_;
  const TraitRules* traits_ = nullptr;
};

}  // namespace crowdface
