// SPDX-License-Identifier: Apache-2.0
#include "crowdface/neck/open_rims.h"

#include <algorithm>
#include <map>
#include <utility>

namespace crowdface {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The edges that belong to exactly one polygon. Each edge has the direction in which this polygon
/// traverses the edge.
std::vector<Edge> open_edges(const Topology& topology, const Adjacency& adjacency) {
  // directed polygon edges, grouped by the undirected edge
  std::map<Edge, std::vector<Edge>> edges;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    for (std::size_t c = 0; c < face.size(); ++c) {
      const std::uint32_t a = face[c], b = face[(c + 1) % face.size()];
      if (a == b || !adjacency.boundary[a] || !adjacency.boundary[b]) continue;
      edges[std::minmax(a, b)].emplace_back(a, b);
    }
  }
  std::vector<Edge> open;
  for (const auto& [ends, polygons] : edges) {
    if (polygons.size() == 1) open.push_back(polygons.front());
  }
  return open;
}

}  // namespace

std::vector<Rim> find_open_rims(const Topology& topology, const Adjacency& adjacency) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> next;
  std::map<std::uint32_t, int> arrivals;
  for (const auto& [a, b] : open_edges(topology, adjacency)) {
    next[a].push_back(b);
    ++arrivals[b];
  }
  std::vector<Rim> rims;
  std::map<std::uint32_t, bool> seen;
  for (const auto& [first, unused] : next) {
    Rim rim;
    for (std::uint32_t at = first; !seen[at];) {
      seen[at] = true;
      if (next[at].size() != 1 || arrivals[at] != 1) break;
      rim.push_back(at);
      at = next[at].front();
      if (at != first) continue;
      rims.push_back(std::move(rim));
      break;
    }
  }
  return rims;
}

Rim rim_through(std::span<const std::uint32_t> vertices, const Adjacency& adjacency) {
  const std::vector<std::uint32_t> sorted = [&] {
    std::vector<std::uint32_t> copy(vertices.begin(), vertices.end());
    std::ranges::sort(copy);
    return copy;
  }();
  const auto neighbours = [&](std::uint32_t v) {
    std::vector<std::uint32_t> own;
    for (const std::uint32_t other : adjacency.items_of(v)) {
      if (std::ranges::binary_search(sorted, other)) own.push_back(other);
    }
    return own;
  };
  Rim rim;
  if (sorted.empty()) return rim;
  std::uint32_t before = kNoIndex, at = sorted.front();
  do {
    const std::vector<std::uint32_t> own = neighbours(at);
    if (own.size() != 2 || rim.size() == sorted.size()) return {};
    rim.push_back(at);
    const std::uint32_t after = own[0] == before ? own[1] : own[0];
    before = std::exchange(at, after);
  } while (at != rim.front());
  return rim.size() == sorted.size() ? rim : Rim();
}

}  // namespace crowdface
