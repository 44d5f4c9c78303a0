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

/// The distances between all pairs of faces; of more faces than 1500 those of every so-many-th.
std::vector<double> pair_distances(const std::vector<FaceSpace::Point>& points);

/// The same over one region, of at most 300 faces.
std::vector<double> pair_distances(const FaceSpace& space, Index region,
                                   const std::vector<FaceSpace::Point>& points);

}  // namespace crowdface
