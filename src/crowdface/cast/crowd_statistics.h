// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/cast/face_space.h"

namespace crowdface {

/// How values are spread, in order.
struct Quartiles {
  std::uint64_t count = 0;
  double min = 0, lower = 0, median = 0, upper = 0, max = 0;
};
Quartiles quartiles(std::vector<double> values);

/// The distances between all pairs of faces; of more faces than `most` those of every so-many-th.
std::vector<double> pair_distances(const std::vector<FaceSpace::Point>& points,
                                   std::size_t most = 1500);

/// The same over one region.
std::vector<double> pair_distances(const FaceSpace& space, Index region,
                                   const std::vector<FaceSpace::Point>& points,
                                   std::size_t most = 300);

}  // namespace crowdface
