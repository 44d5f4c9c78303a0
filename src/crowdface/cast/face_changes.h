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

/// Applies the changes of a review to faces, after the faces' earlier changes; see
/// CastingResult::changed. If a face cannot be redrawn, sets the shortfall.
///
/// - A redrawn face keeps its group and its age, unless it gets another group. It keeps the crowd's
///   distances from the first versions of the faces before it in the plan. So it does not change
///   when the crowd grows or other faces are redrawn.
/// - A variant is a mixture of the other face, as it is before these changes, and a random face on
///   the same target, at the requested distance from the other face.
/// - With limits on measurements only, the face is a mixture of itself and a random face that meets
///   the limits. The share of the random face is as small as the limits allow: none if the face
///   already meets them.
///
/// \param by  the origin of the changes, such as "review 2".
/// \throws InvalidInput if a face is not in the crowd.
void apply_changes(const CastingOptions& casting, const FaceJudge& judge,
                   const std::vector<FaceChange>& changes, const std::string& by,
                   CastingResult& cast);

/// Keeps faces that are cast or redrawn later at a distance from the faces that reviews have
/// changed.
class AvoidedFaces {
 public:
  /// \param cast     the crowd with the changes of the reviews so far.
  /// \param settled  #crowd: faces that are not being redrawn. Empty: all.
  AvoidedFaces(const CastingResult& cast, double min_distance_mm,
               const std::vector<bool>& settled = {});
  /// Returns why a point is rejected; nothing if it is accepted.
  std::optional<Reason> rejection_reason(const FaceSpace::Point& point) const;

 private:
  double min_distance_mm_;
  std::vector<FaceSpace::Point> points_;  ///< points of the changed faces
};

/// Applies the changes of the config, before the reviews' changes.
void apply_changes_of_config(const CastingOptions& casting, const FaceJudge& judge,
                             CastingResult& cast);

/// Applies the changes of a face again, after it was redrawn.
void reapply_changes(const CastingOptions& casting, const FaceJudge& judge, std::size_t face,
                     CastingResult& cast);

}  // namespace crowdface
