// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"
#include "crowdface/cast/nearest_face_search.h"

namespace crowdface {

/// A request to sample several faces. The user chooses among the sampled faces.
struct SampleRequest {
  /// the face to sample again; the sampled faces keep its id and its locked bands
  FacePlan start_face;
  /// bands that do not change, indexed as in ReviewMark::locked_bands. If the list is not empty,
  /// the target does not change either.
  std::vector<std::size_t> locked_bands;
  std::optional<FacePlan> original;  ///< if set, sample variations of this face
  /// 0 to 1: how far a variation moves from `original` (0) towards an independently sampled face
  /// (1)
  double variation = 1;
  std::size_t count = 1;  ///< number of faces to sample
  /// Number of the first sampling attempt. Each attempt has its own number, and attempts with
  /// different numbers sample different faces.
  std::uint32_t first_attempt = 0;
};

/// Samples faces that satisfy the limits of the config. Without `original`, the sampled faces also
/// keep the minimum distance from the faces of the crowd.
/// \return fewer faces than requested if too many attempts violate the limits.
/// \throws Unsatisfiable if all attempts violate the limits.
std::vector<FacePlan> sample_faces(const CastingOptions& casting, const FaceJudge& judge,
                                   const NearestFaceSearch& crowd, const SampleRequest& request);

}  // namespace crowdface
