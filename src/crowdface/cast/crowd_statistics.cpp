// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/crowd_statistics.h"

#include <algorithm>
#include <functional>

#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

using Distance = std::function<double(const FaceSpace::Place&, const FaceSpace::Place&)>;

std::vector<double> pair_distances_by(const Distance& distance,
                                      const std::vector<FaceSpace::Place>& places,
                                      std::size_t most) {
  std::vector<const FaceSpace::Place*> chosen;
  const std::size_t count = std::min(places.size(), most);
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(&places[i * places.size() / count]);
  std::vector<double> distances(count * (count - (count > 0 ? 1 : 0)) / 2);
  parallel_for_each(static_cast<Index>(count), [&](Index i) {
    const auto at = static_cast<std::size_t>(i);
    for (std::size_t j = 0; j < at; ++j) {
      distances[at * (at - 1) / 2 + j] = distance(*chosen[at], *chosen[j]);
    }
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

std::vector<double> pair_distances(const std::vector<FaceSpace::Place>& places, std::size_t most) {
  return pair_distances_by(FaceSpace::distance, places, most);
}

std::vector<double> pair_distances(const FaceSpace& space, Index region,
                                   const std::vector<FaceSpace::Place>& places, std::size_t most) {
  return pair_distances_by(
      [&](const FaceSpace::Place& a, const FaceSpace::Place& b) {
        return space.region_distance(a, b, region);
      },
      places, most);
}

}  // namespace crowdface
