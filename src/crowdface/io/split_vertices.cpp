// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/split_vertices.h"

#include <numeric>

namespace crowdface {
namespace {

/// Finds, or makes, the split vertex of a vertex with a texture coordinate. Those of one vertex are
/// a chain, seldom longer than two.
class Splitter {
 public:
  explicit Splitter(Index vertices)
      : next_(static_cast<std::size_t>(vertices), kNoIndex),
        uvs_(static_cast<std::size_t>(vertices), kNoIndex),
        seen_(static_cast<std::size_t>(vertices), false),
        vertices_(static_cast<std::size_t>(vertices)) {
    std::iota(vertices_.begin(), vertices_.end(), 0U);
  }

  std::uint32_t find(std::uint32_t vertex, std::uint32_t uv) {
    if (!seen_[vertex]) {
      seen_[vertex] = true;
      uvs_[vertex] = uv;
      return vertex;
    }
    std::uint32_t split = vertex;
    while (uvs_[split] != uv) {
      if (next_[split] == kNoIndex) return append(split, vertex, uv);
      split = next_[split];
    }
    return split;
  }

  std::vector<std::uint32_t> take_vertices() { return std::move(vertices_); }
  std::vector<std::uint32_t> take_uvs() { return std::move(uvs_); }

 private:
  std::uint32_t append(std::uint32_t last, std::uint32_t vertex, std::uint32_t uv) {
    const auto split = static_cast<std::uint32_t>(vertices_.size());
    next_[last] = split;
    next_.push_back(kNoIndex);
    uvs_.push_back(uv);
    vertices_.push_back(vertex);
    return split;
  }

  std::vector<std::uint32_t> next_, uvs_;
  std::vector<bool> seen_;
  std::vector<std::uint32_t> vertices_;
};

}  // namespace

SplitVertices split_vertices(const Topology& topology) {
  const bool has_uvs = !topology.corner_uvs.empty();
  Splitter splitter(topology.vertex_count);
  std::vector<std::uint32_t> corners(topology.corner_vertices.size());
  for (std::size_t c = 0; c < corners.size(); ++c) {
    corners[c] =
        splitter.find(topology.corner_vertices[c], has_uvs ? topology.corner_uvs[c] : kNoIndex);
  }
  SplitVertices split;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [begin, end] = topology.corners(f);
    for (std::uint32_t c = begin + 1; c + 1 < end; ++c) {
      split.triangles.push_back({corners[begin], corners[c], corners[c + 1]});
      split.triangle_faces.push_back(static_cast<std::uint32_t>(f));
    }
  }
  split.vertices = splitter.take_vertices();
  if (has_uvs) split.uvs = splitter.take_uvs();
  return split;
}

}  // namespace crowdface
