// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/casting_result.h"
#include "crowdface/cast/constraints.h"
#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"
#include "crowdface/cast/face_space.h"

namespace crowdface {

/// Applies the changes of a review to faces, after the changes that these faces already have; see
/// CastingResult::changed. If a face cannot be redrawn, sets the shortfall.
///
/// - A redrawn face keeps its group and its age, unless the change gives it another group. It keeps
///   the crowd's minimum distance from the faces before it in the plan. The distances are measured
///   to the versions of these faces before all reviews. So a redrawn face stays the same when the
///   crowd grows or other faces are redrawn.
/// - A variant is a mixture of another face (as it is before these changes) and a random face. The
///   random face is built on the target of the other face. The variant has the requested distance
///   from the other face.
/// - If a change sets only limits on measurements, the changed face is a mixture of the old face
///   and a random face that meets the limits. The fraction of the random face is as small as the
///   limits allow: zero if the old face already meets the limits.
///
/// \param origin  the origin of the changes, such as "review 2".
/// \throws InvalidInput if a face is not in the crowd.
void apply_changes(const CastingOptions& casting, const FaceJudge& judge,
                   const std::vector<FaceChange>& changes, const std::string& origin,
                   CastingResult& cast);

/// The faces that earlier reviews have changed. Faces that are cast or redrawn later must keep a
/// minimum distance from these faces.
class AvoidedFaces {
 public:
  /// \param cast  the crowd with the changes of the reviews so far.
  /// \param is_considered  one entry per face of the crowd: false if the face is ignored because it
  ///                       is being redrawn. Empty: no face is ignored.
  AvoidedFaces(const CastingResult& cast, double min_distance_mm,
               const std::vector<bool>& is_considered = {});
  /// Returns why a face is rejected, given the face's point; nothing if the face is accepted.
  std::optional<RejectionReason> rejection_reason(const FaceSpace::Point& point) const;

 private:
  double min_distance_mm_;  ///< smallest allowed distance from each point in `points_`
  std::vector<FaceSpace::Point> points_;  ///< points of the changed faces
};

/// Returns the head and the face of the crowd that are nearest to a point.
///
/// \param is_considered  One entry per face of the crowd: whether the face is compared.
NearestNeighbours nearest_neighbours(const FaceJudge& judge, const CastingResult& cast,
                                     const FaceSpace::Point& point,
                                     const std::vector<bool>& is_considered);

/// Applies the changes that the config requests. If a face already has changes that reviews
/// request, undoes them, applies the config's changes first, and then applies the reviews' changes
/// again.
void apply_changes_of_config(const CastingOptions& casting, const FaceJudge& judge,
                             CastingResult& cast);

/// Applies a face's changes again, after the face was redrawn.
void reapply_changes(const CastingOptions& casting, const FaceJudge& judge, std::size_t face,
                     CastingResult& cast);

}  // namespace crowdface
