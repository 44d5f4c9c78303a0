// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"
#include "crowdface/cast/nearest_face_search.h"

namespace crowdface {

/// A request to sample faces from which the user chooses.
struct SampleRequest {
  FacePlan start_face;  ///< the face to sample anew: supplies the id and all locked parts
  std::vector<std::size_t>
      locked;  ///< parts that do not change, as in reviews; if any is locked, so is the target
  std::optional<FacePlan> original;  ///< sample variations of this face
  /// how far variations move from `original` towards an independently sampled face, 0 to 1
  double variation = 1;
  std::size_t count = 1;            ///< number of faces to sample
  std::uint32_t first_attempt = 0;  ///< a different number yields different faces
};

/// Samples faces that satisfy the limits of the config. Without `original`, the faces also keep the
/// minimum distance from the crowd.
/// \return fewer faces than requested if too many attempts violate the limits.
/// \throws Unsatisfiable if all attempts violate the limits.
std::vector<FacePlan> sample_faces(const CastingOptions& casting, const FaceJudge& judge,
                                   const NearestFaceSearch& crowd, const SampleRequest& request);

}  // namespace crowdface
