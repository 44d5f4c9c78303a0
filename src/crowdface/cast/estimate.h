// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/cast/draw_recipe.h"
#include "crowdface/cast/face_judge.h"

namespace crowdface {

/// The distance that a given number of faces can keep.
struct EstimateRow {
  std::uint64_t faces = 0;
  double spread_distance_mm = 0;  ///< smallest distance between two faces of a spread set
  /// largest min_distance at which first fit finds this many faces
  double first_fit_distance_mm = 0;
};

/// Estimates the capacity of the heads: the distance that crowds of several sizes can keep, from a
/// pool of candidates sampled as in casting. One greedy pass gives the spread sets of all sizes;
/// first fit is tried at a few distances for each size.
///
/// \param counts     Crowd sizes, ascending. Sizes that are too large for the pool are left out.
/// \param pool_size  Number of candidates. More candidates give better estimates, and take longer.
std::vector<EstimateRow> estimate_capacity(const CastingOptions& casting, const FaceJudge& judge,
                                           const std::vector<std::uint64_t>& counts,
                                           std::uint64_t pool_size);

}  // namespace crowdface
