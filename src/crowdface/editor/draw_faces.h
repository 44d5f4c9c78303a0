// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"
#include "crowdface/cast/face_point_index.h"

namespace crowdface {

/// A request to draw faces for the user to choose from.
struct DrawRequest {
  FacePlan from;  ///< the face to redraw: supplies the id and all locked parts
  std::vector<std::size_t>
      locked;  ///< parts that do not change, as in reviews; if any is locked, so is the target
  std::optional<FacePlan> like;  ///< draw variations of this face
  double amount = 1;  ///< how far variations move from `like` towards a freely drawn face, 0 to 1
  std::size_t count = 1;            ///< number of faces to draw
  std::uint32_t first_attempt = 0;  ///< a different number yields different faces
};

/// Draws faces that satisfy the limits of the config. Without `like`, the faces also keep the
/// minimum distance from the crowd.
/// \return fewer faces than requested if too many attempts violate the limits.
/// \throws Unsatisfiable if all attempts violate the limits.
std::vector<FacePlan> draw_faces(const CastingOptions& casting, const FaceJudge& judge,
                                 const FacePointIndex& crowd, const DrawRequest& request);

}  // namespace crowdface
