// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/cast/face_space.h"

namespace crowdface {

/// Count, minimum, maximum and quartiles of a set of values.
struct Quartiles {
  std::uint64_t count = 0;  ///< number of values
  double min = 0, lower_quartile = 0, median = 0, upper_quartile = 0, max = 0;
};
Quartiles quartiles(std::vector<double> values);

/// Returns the distances (mm) between all pairs of faces. If there are more than 1500 faces, uses
/// only 1500 faces, whose indices are evenly spaced.
std::vector<double> pair_distances(const std::vector<FaceSpace::Point>& points);

/// Returns the distances (mm) between all pairs of faces, measured over one region only. If there
/// are more than 300 faces, uses only 300 faces, whose indices are evenly spaced.
std::vector<double> pair_distances(const FaceSpace& space, Index region,
                                   const std::vector<FaceSpace::Point>& points);

}  // namespace crowdface
