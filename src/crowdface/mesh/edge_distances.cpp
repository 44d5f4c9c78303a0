// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/edge_distances.h"

#include <cmath>
#include <functional>
#include <queue>
#include <tuple>

namespace crowdface {
namespace {

using Open = std::tuple<double, std::uint32_t, std::uint32_t>;  // distance, source, vertex

}  // namespace

EdgeDistances::EdgeDistances(const Adjacency& adjacency, const Positions& positions)
    : adjacency_(adjacency),
      positions_(positions),
      distances_(static_cast<std::size_t>(positions.rows()),
                 std::numeric_limits<double>::infinity()),
      sources_(static_cast<std::size_t>(positions.rows()), kNoIndex) {}

void EdgeDistances::search(std::span<const std::uint32_t> sources, double limit) {
  for (const std::uint32_t v : reached_) {
    distances_[v] = std::numeric_limits<double>::infinity();
    sources_[v] = kNoIndex;
  }
  reached_.clear();
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    open.emplace(0.0, static_cast<std::uint32_t>(s), sources[s]);
  }
  while (!open.empty()) {
    const auto [distance, source, vertex] = open.top();
    open.pop();
    if (sources_[vertex] != kNoIndex) continue;
    distances_[vertex] = distance;
    sources_[vertex] = source;
    reached_.push_back(vertex);
    for (const std::uint32_t next : adjacency_.of(vertex)) {
      if (sources_[next] != kNoIndex) continue;
      double squared = 0;
      for (int c = 0; c < 3; ++c) {
        const double d = positions_(next, c) - positions_(vertex, c);
        squared += d * d;
      }
      const double there = distance + std::sqrt(squared);
      if (there <= limit) open.emplace(there, source, next);
    }
  }
}

}  // namespace crowdface
