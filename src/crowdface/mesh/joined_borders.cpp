// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/joined_borders.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace crowdface {
namespace {

/// Returns for each vertex whether it lies on an edge that has a polygon on one side only. A vertex
/// without a polygon counts as a border vertex.
std::vector<bool> border_vertices(const Topology& topology) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::vector<bool> is_border(static_cast<std::size_t>(topology.vertex_count), true);
  edges.reserve(topology.corner_vertices.size());
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    for (std::size_t c = 0; c < face.size(); ++c) {
      edges.emplace_back(face[c], face[(c + 1) % face.size()]);
      is_border[face[c]] = false;
    }
  }
  std::ranges::sort(edges);
  for (const auto& [a, b] : edges) {
    if (!std::ranges::binary_search(edges, std::pair(b, a))) is_border[a] = is_border[b] = true;
  }
  return is_border;
}

}  // namespace

JoinedBorders joined_borders(const Topology& topology, const Positions& positions,
                             const std::vector<std::uint32_t>& piece_of_vertex) {
  const std::vector<bool> is_border = border_vertices(topology);
  JoinedBorders result;
  std::map<std::array<double, 4>, std::uint32_t> row_at_place;
  for (std::uint32_t v = 0; v < is_border.size(); ++v) {
    const auto next = static_cast<std::uint32_t>(result.first_copy_of_joined_vertex.size());
    std::uint32_t joined = next;
    if (is_border[v]) {
      const auto row = positions.row(v);
      const double piece = piece_of_vertex.empty() ? 0 : piece_of_vertex[v];
      joined = row_at_place.try_emplace({piece, row[0], row[1], row[2]}, next).first->second;
    }
    if (joined == next) result.first_copy_of_joined_vertex.push_back(v);
    result.joined_vertex_of_vertex.push_back(joined);
  }
  return result;
}

}  // namespace crowdface
