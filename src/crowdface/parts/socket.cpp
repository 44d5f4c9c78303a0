// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/socket.h"

#include <algorithm>

namespace crowdface {
namespace {

/// More vertices than this change a motion by less than a hundredth of a millimetre.
constexpr std::size_t kMostVertices = 1500;

}  // namespace

Socket find_socket(const Positions& positions, const PointGrid& part,
                   std::span<const std::uint32_t> skin, const std::vector<double>& areas,
                   double reach) {
  Socket all;
  for (const std::uint32_t v : skin) {
    const auto nearest = part.nearest(positions.row(v).transpose(), reach);
    if (nearest.vertex == kNoIndex) continue;
    const double t = nearest.distance / reach;
    const double weight = areas[v] * (1 - t * t) * (1 - t * t);
    if (weight <= 0) continue;
    all.vertices.push_back(v);
    all.weights.push_back(weight);
  }
  if (all.vertices.size() <= kMostVertices) return all;
  Socket some;
  for (std::size_t i = 0; i < kMostVertices; ++i) {
    const std::size_t k = i * all.vertices.size() / kMostVertices;
    some.vertices.push_back(all.vertices[k]);
    some.weights.push_back(all.weights[k]);
  }
  return some;
}

bool unmoved(const Positions& before, const Positions& after,
             std::span<const std::uint32_t> vertices) {
  return std::all_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) {
    return before(v, 0) == after(v, 0) && before(v, 1) == after(v, 1) &&
           before(v, 2) == after(v, 2);
  });
}

}  // namespace crowdface
