// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/crowd_statistics.h"

#include <algorithm>

#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"

namespace crowdface {
namespace {

/// Calls distance(i, j) for each pair of faces j < i < count, and returns the results.
template <class Distance>
std::vector<double> pairwise(std::size_t count, const Distance& distance) {
  std::vector<double> distances(count * (count - (count > 0 ? 1 : 0)) / 2);
  parallel_for_each(count, [&](std::size_t i) {
    for (std::size_t j = 0; j < i; ++j) distances[i * (i - 1) / 2 + j] = distance(i, j);
  });
  return distances;
}

}  // namespace

Quartiles quartiles(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](std::size_t quarter) {
    return values[std::min(values.size() * quarter / 4, values.size() - 1)];
  };
  return {values.size(), values.front(), at(1), at(2), at(3), values.back()};
}

std::vector<double> pair_distances(const std::vector<FaceSpace::Point>& points) {
  const auto chosen = evenly_spaced_items(points, 1500);
  return pairwise(chosen.size(), [&](std::size_t i, std::size_t j) {
    return FaceSpace::distance(chosen[i], chosen[j]);
  });
}

std::vector<double> pair_distances(const FaceSpace& space, Index region,
                                   const std::vector<FaceSpace::Point>& points) {
  const auto chosen = evenly_spaced_items(points, 300);
  std::vector<FaceSpace::RegionPoint> region_points(chosen.size());
  parallel_for_each(chosen.size(), [&](std::size_t i) {
    region_points[i] = space.region_point(chosen[i], region);
  });
  return pairwise(chosen.size(), [&](std::size_t i, std::size_t j) {
    return space.region_distance(region_points[i], region_points[j], region);
  });
}

}  // namespace crowdface
