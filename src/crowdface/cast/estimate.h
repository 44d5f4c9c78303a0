// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"

namespace crowdface {

/// How far apart so many faces can be.
struct EstimateRow {
  std::uint64_t faces = 0;
  double spread_mm = 0;     ///< closest pair of a spread set
  double first_fit_mm = 0;  ///< min_distance that first fit reaches so many faces with
};

/// What a face set holds: faces against the distance that can be kept between them, from a pool of
/// candidates drawn as casting draws them. One greedy pass tells the spread set for every count at
/// once; first fit is tried at a few distances for each.
/// \param counts     ascending; those beyond what the pool can tell are left out.
/// \param pool_size  how many candidates; more tell more, and take longer.
std::vector<EstimateRow> estimate_capacity(const Casting& casting, const FaceJudge& judge,
                                           const std::vector<std::uint64_t>& counts,
                                           std::uint64_t pool_size);

}  // namespace crowdface
