// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"
#include "crowdface/cast/face_point_index.h"

namespace crowdface {

/// Faces to choose from.
struct DrawRequest {
  CastFace from;  ///< gives the id, and all that is locked
  std::vector<std::size_t>
      locked;                    ///< parts that stay, as in reviews; with any the target stays too
  std::optional<CastFace> like;  ///< draw around this face
  double amount = 1;      ///< with `like`: how far, 0 … 1, towards a face that is drawn freely
  std::size_t count = 1;  ///< how many
  std::uint32_t first_attempt = 0;  ///< another number, other faces
};

/// Draws faces that keep the limits of the config, the distance from the crowd among them.
/// \return fewer than asked for if they are hard to find.
/// \throws Unsatisfiable if none was found.
std::vector<CastFace> draw_faces(const Casting& casting, const FaceJudge& judge,
                                 const FacePointIndex& crowd, const DrawRequest& request);

}  // namespace crowdface
