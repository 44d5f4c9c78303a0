// SPDX-License-Identifier: Apache-2.0
#include "crowdface/neck/body_below.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/mesh/disjoint_sets.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

template <class Visit>
void visit_edges(const Topology& topology, const Visit& visit) {
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    for (std::size_t c = 0; c < face.size(); ++c) {
      visit(static_cast<std::uint32_t>(f), Edge(std::minmax(face[c], face[(c + 1) % face.size()])));
    }
  }
}

double height(const Topology& topology, const Positions& positions, Index face,
              const Eigen::Vector3d& up) {
  double sum = 0;
  for (const std::uint32_t v : topology.face(face)) sum += row3(positions, v).dot(up);
  return sum / static_cast<double>(topology.face(face).size());
}

}  // namespace

std::vector<bool> polygons_below(const Topology& topology, const Positions& positions,
                                 const Rim& rim, const Eigen::Vector3d& up) {
  std::map<Edge, double> loop;  // the height of each edge of the loop
  double middle = 0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const std::uint32_t a = rim[i], b = rim[(i + 1) % rim.size()];
    loop[std::minmax(a, b)] = (row3(positions, a) + row3(positions, b)).dot(up) / 2;
    middle += row3(positions, a).dot(up) / static_cast<double>(rim.size());
  }
  std::vector<std::pair<Edge, std::uint32_t>> edges;
  const auto faces = static_cast<std::size_t>(topology.face_count());
  // For each part that touches the loop: the sum, over the part's polygons with an edge on the
  // loop, of the height of the polygon's centre above the middle of this edge. The sum is stored at
  // the index of the part's root polygon.
  std::vector<double> height_above_loop(faces, 0.0);
  visit_edges(topology, [&](std::uint32_t f, const Edge& edge) { edges.emplace_back(edge, f); });
  std::ranges::sort(edges);
  DisjointSets parts(faces);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (edges[i].first == edges[i + 1].first && !loop.contains(edges[i].first)) {
      parts.join(edges[i].second, edges[i + 1].second);
    }
  }
  std::size_t along = 0;
  std::set<std::uint32_t> sides;  // parts with polygons along the loop
  for (const auto& [edge, f] : edges) {
    const auto at = loop.find(edge);
    if (at == loop.end()) continue;
    ++along;
    height_above_loop[parts.root(f)] += height(topology, positions, f, up) - at->second;
    sides.insert(parts.root(f));
  }
  if (along == loop.size()) return std::vector<bool>(faces, true);
  if (sides.size() < 2) {
    throw InvalidInput("the loop of neck.body_rim does not separate the body from the head");
  }
  // For each part that does not touch the loop: the sum, over the part's polygons, of the height
  // above the middle of the loop. The sum is stored at the index of the part's root polygon.
  std::vector<double> height_above_middle(faces, 0.0);
  for (std::uint32_t f = 0; f < faces; ++f) {
    height_above_middle[parts.root(f)] += height(topology, positions, f, up) - middle;
  }
  std::vector<bool> below(faces);
  for (std::uint32_t f = 0; f < faces; ++f) {
    const std::uint32_t part = parts.root(f);
    below[f] = (sides.contains(part) ? height_above_loop[part] : height_above_middle[part]) < 0;
  }
  return below;
}

}  // namespace crowdface
