// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/edge_distances.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

EdgeDistances::EdgeDistances(const Adjacency& adjacency, const Positions& positions)
    : adjacency_(adjacency),
      positions_(positions),
      distances_(static_cast<std::size_t>(positions.rows()), kInfinity),
      sources_(static_cast<std::size_t>(positions.rows()), kNoIndex),
      settled_(static_cast<std::size_t>(positions.rows()), false) {}

void EdgeDistances::begin(std::span<const std::uint32_t> sources) {
  for (const std::uint32_t v : touched_) {
    distances_[v] = kInfinity;
    sources_[v] = kNoIndex;
    settled_[v] = false;
  }
  reached_.clear();
  touched_.clear();
  queue_.clear();
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const std::uint32_t v = sources[s];
    if (distances_[v] == 0) continue;  // keep a source's first occurrence
    distances_[v] = 0;
    sources_[v] = static_cast<std::uint32_t>(s);
    touched_.push_back(v);
    queue_.emplace_back(0.0, sources_[v], v);
  }
  std::make_heap(queue_.begin(), queue_.end(), std::greater<>());
}

template <class ContinuesFrom, class IsDone>
void EdgeDistances::settle(const ContinuesFrom& continues_from, const IsDone& is_done) {
  while (!queue_.empty()) {
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    const auto [distance, source, vertex] = queue_.back();
    queue_.pop_back();
    if (settled_[vertex]) continue;
    settled_[vertex] = true;
    reached_.push_back(vertex);
    if (is_done(vertex)) return;
    for (const std::uint32_t next : adjacency_.items_of(vertex)) {
      if (settled_[next]) continue;
      double squared = 0;
      for (int c = 0; c < 3; ++c) {
        const double d = positions_(next, c) - positions_(vertex, c);
        squared += d * d;
      }
      const double there = distance + std::sqrt(squared);
      if (std::tie(there, source) >= std::tie(distances_[next], sources_[next])) continue;
      if (!continues_from(there, next)) continue;
      if (distances_[next] == kInfinity) touched_.push_back(next);
      distances_[next] = there;
      sources_[next] = source;
      queue_.emplace_back(there, source, next);
      std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
    }
  }
}

void EdgeDistances::search(std::span<const std::uint32_t> sources, double limit) {
  begin(sources);
  settle([&](double distance, std::uint32_t) { return distance <= limit; },
         [](std::uint32_t) { return false; });
}

void EdgeDistances::search_for(std::uint32_t source, std::span<const std::uint32_t> goals,
                               double limit) {
  begin(std::span(&source, 1));
  if (goals.empty()) return;
  // Compute a ball that contains all goals. A path through a vertex v cannot reach a goal within
  // `limit` if the path's length up to v plus the distance from v to the ball exceeds `limit`.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const std::uint32_t goal : goals) middle += row3(positions_, goal);
  middle /= static_cast<double>(goals.size());
  double radius = 0;
  for (const std::uint32_t goal : goals) {
    radius = std::max(radius, (row3(positions_, goal) - middle).norm());
  }
  constexpr double kRounding = 1e-9;
  const double farthest = (limit + radius) * (1 + kRounding);
  std::size_t left = goals.size();
  settle(
      [&](double distance, std::uint32_t vertex) {
        return distance <= limit &&
               distance + (row3(positions_, vertex) - middle).norm() <= farthest;
      },
      [&](std::uint32_t vertex) {
        left -= std::ranges::count(goals, vertex);
        return left == 0;
      });
}

std::vector<std::uint32_t> nearest_along_edges(const Adjacency& adjacency,
                                               const Positions& positions,
                                               std::span<const std::uint32_t> sources) {
  using Reached = std::pair<double, std::uint32_t>;
  std::vector<double> distances(static_cast<std::size_t>(adjacency.vertex_count()), kInfinity);
  std::vector<std::uint32_t> nearest(distances.size(), kNoIndex);
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  for (std::uint32_t i = 0; i < sources.size(); ++i) {
    distances[sources[i]] = 0;
    nearest[sources[i]] = i;
    open.emplace(0.0, sources[i]);
  }
  while (!open.empty()) {
    const auto [distance, v] = open.top();
    open.pop();
    if (distance > distances[v]) continue;
    for (const std::uint32_t next : adjacency.items_of(v)) {
      const double there = distance + (row3(positions, next) - row3(positions, v)).norm();
      if (there >= distances[next]) continue;
      distances[next] = there;
      nearest[next] = nearest[v];
      open.emplace(there, next);
    }
  }
  return nearest;
}

}  // namespace crowdface
