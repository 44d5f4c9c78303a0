// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/crowd_statistics.h"

#include <algorithm>

#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

/// Up to `most` of `points`, evenly spread.
std::vector<const FaceSpace::Point*> some_of(const std::vector<FaceSpace::Point>& points,
                                             std::size_t most) {
  std::vector<const FaceSpace::Point*> chosen;
  const std::size_t count = std::min(points.size(), most);
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(&points[i * points.size() / count]);
  return chosen;
}

/// distance(i, j) for all j < i < count.
template <class Distance>
std::vector<double> pairwise(std::size_t count, const Distance& distance) {
  std::vector<double> distances(count * (count - (count > 0 ? 1 : 0)) / 2);
  parallel_for_each(static_cast<Index>(count), [&](Index i) {
    const auto at = static_cast<std::size_t>(i);
    for (std::size_t j = 0; j < at; ++j) distances[at * (at - 1) / 2 + j] = distance(at, j);
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

std::vector<double> pair_distances(const std::vector<FaceSpace::Point>& points, std::size_t most) {
  const auto chosen = some_of(points, most);
  return pairwise(chosen.size(), [&](std::size_t i, std::size_t j) {
    return FaceSpace::distance(*chosen[i], *chosen[j]);
  });
}

std::vector<double> pair_distances(const FaceSpace& space, Index region,
                                   const std::vector<FaceSpace::Point>& points, std::size_t most) {
  const auto chosen = some_of(points, most);
  std::vector<FaceSpace::RegionPoint> in_region(chosen.size());
  parallel_for_each(static_cast<Index>(chosen.size()), [&](Index i) {
    const auto at = static_cast<std::size_t>(i);
    in_region[at] = space.in_region(*chosen[at], region);
  });
  return pairwise(chosen.size(), [&](std::size_t i, std::size_t j) {
    return space.region_distance(in_region[i], in_region[j], region);
  });
}

}  // namespace crowdface
