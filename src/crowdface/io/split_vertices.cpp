// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/split_vertices.h"

#include <numeric>

namespace crowdface {

SplitVertices split_vertices(const Topology& topology) {
  const bool has_uvs = !topology.corner_uvs.empty();
  const auto count = static_cast<std::size_t>(topology.vertex_count);
  SplitVertices split;
  split.vertices.resize(count);
  std::iota(split.vertices.begin(), split.vertices.end(), 0U);
  split.uvs.assign(count, kNoIndex);
  std::vector<bool> seen(count, false);
  // A linked list for each original vertex: next[s] is the split vertex after s in the list. The
  // lists rarely have more than two entries.
  std::vector<std::uint32_t> next(count, kNoIndex);
  const auto find = [&](std::uint32_t vertex, std::uint32_t uv) {
    if (!seen[vertex]) split.uvs[vertex] = uv;
    seen[vertex] = true;
    std::uint32_t at = vertex;
    while (split.uvs[at] != uv) {
      if (next[at] == kNoIndex) {
        next[at] = static_cast<std::uint32_t>(next.size());
        next.push_back(kNoIndex);
        split.vertices.push_back(vertex);
        split.uvs.push_back(uv);
      }
      at = next[at];
    }
    return at;
  };
  std::vector<std::uint32_t> corners(topology.corner_vertices.size());
  for (std::size_t c = 0; c < corners.size(); ++c) {
    corners[c] = find(topology.corner_vertices[c], has_uvs ? topology.corner_uvs[c] : kNoIndex);
  }
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [begin, end] = topology.corners(f);
    for (std::uint32_t c = begin + 1; c + 1 < end; ++c) {
      split.triangles.push_back({corners[begin], corners[c], corners[c + 1]});
      split.triangle_faces.push_back(static_cast<std::uint32_t>(f));
    }
  }
  if (!has_uvs) split.uvs.clear();
  return split;
}

}  // namespace crowdface
