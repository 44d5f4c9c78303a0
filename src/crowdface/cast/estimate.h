// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"

namespace crowdface {

/// An estimate for one size of the crowd: how far apart the faces of such a crowd can be.
struct EstimateRow {
  std::uint64_t face_count = 0;  ///< size of the crowd
  /// smallest distance in mm between two faces if the crowd is cast in spread mode
  double distance_in_spread_mode_mm = 0;
  /// largest minimum distance in mm at which first-fit casting finds this many faces
  double distance_in_first_fit_casting_mm = 0;
};

/// Estimates, for crowds of several sizes, the minimum distance that the faces can keep. Uses a
/// pool of candidates, which are sampled as in casting. For spread mode, one greedy pass gives the
/// distances of all crowd sizes. For first-fit casting, tries a few distances for each crowd size.
///
/// \param counts     Crowd sizes, ascending. The result leaves out sizes below 2 and sizes that are
///                   too large for the pool.
/// \param pool_size  Number of candidates. More candidates give better estimates but take longer.
std::vector<EstimateRow> estimate_capacity(const CastingOptions& casting, const FaceJudge& judge,
                                           const std::vector<std::uint64_t>& counts,
                                           std::uint64_t pool_size);

}  // namespace crowdface
