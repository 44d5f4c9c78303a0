// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/socket.h"

#include "crowdface/core/selection.h"

namespace crowdface {
namespace {

/// kMaxKept: largest number of vertices in a socket; more would change the motion by less than 0.01
/// mm. kMaxMeasured: largest number of vertices whose distance from the part is measured.
constexpr std::size_t kMaxKept = 1500, kMaxMeasured = 16 * kMaxKept;

}  // namespace

Socket find_socket(const Positions& positions, const PointGrid& part,
                   std::span<const std::uint32_t> skin, const std::vector<double>& areas,
                   double reach) {
  std::vector<std::uint32_t> around;
  for (const std::uint32_t v : skin) {
    if (part.may_have_vertex_within(positions.row(v).transpose(), reach)) around.push_back(v);
  }
  Socket all;
  for (const std::uint32_t v : evenly_spaced_items(around, kMaxMeasured)) {
    const auto nearest = part.nearest(positions.row(v).transpose(), reach);
    if (nearest.vertex == kNoIndex) continue;
    const double t = nearest.distance / reach;
    const double weight = areas[v] * (1 - t * t) * (1 - t * t);
    if (weight <= 0) continue;
    all.vertices.push_back(v);
    all.weights.push_back(weight);
  }
  return {evenly_spaced_items(all.vertices, kMaxKept), evenly_spaced_items(all.weights, kMaxKept)};
}

}  // namespace crowdface
