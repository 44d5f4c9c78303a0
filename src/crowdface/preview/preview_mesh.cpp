// SPDX-License-Identifier: Apache-2.0
#include "crowdface/preview/preview_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "crowdface/core/grouped.h"
#include "crowdface/preview/reduced_mesh.h"

namespace crowdface {
namespace {

/// The distinct texture coordinates of some vertices of the whole mesh, ascending rows.
std::vector<std::vector<std::uint32_t>> uvs_of(const std::vector<std::uint32_t>& vertices,
                                               const Topology& topology) {
  std::vector<std::uint32_t> place(static_cast<std::size_t>(topology.vertex_count), kNoIndex);
  for (std::uint32_t i = 0; i < vertices.size(); ++i) place[vertices[i]] = i;
  std::vector<std::vector<std::uint32_t>> rows(vertices.size());
  for (std::size_t c = 0; c < topology.corner_uvs.size(); ++c) {
    const std::uint32_t i = place[topology.corner_vertices[c]];
    if (i == kNoIndex || topology.corner_uvs[c] == kNoIndex) continue;
    const auto at = std::ranges::lower_bound(rows[i], topology.corner_uvs[c]);
    if (at == rows[i].end() || *at != topology.corner_uvs[c]) {
      rows[i].insert(at, topology.corner_uvs[c]);
    }
  }
  return rows;
}

using Corners = std::array<std::uint32_t, 3>;

/// Of the texture coordinates that a triangle's corners may have those that lie closest together: a
/// reduced triangle has no face of the whole mesh to take them from, and seams are far apart.
Corners closest_uvs(const TextureCoordinates& uvs,
                    const std::array<const std::vector<std::uint32_t>*, 3>& choices) {
  Corners best = {kNoIndex, kNoIndex, kNoIndex};
  double shortest = HUGE_VAL;
  for (const std::uint32_t a : *choices[0]) {
    for (const std::uint32_t b : *choices[1]) {
      for (const std::uint32_t c : *choices[2]) {
        const double around = (uvs.row(a) - uvs.row(b)).norm() + (uvs.row(b) - uvs.row(c)).norm() +
                              (uvs.row(c) - uvs.row(a)).norm();
        if (around >= shortest) continue;
        shortest = around;
        best = {a, b, c};
      }
    }
  }
  return best;
}

}  // namespace

PreviewMesh preview_mesh(const Topology& topology, const TextureCoordinates& uvs,
                         const Positions& typical, const std::vector<bool>& drawn,
                         std::size_t most_vertices) {
  const ReducedMesh reduced = reduce_mesh(topology, typical, drawn, 2 * most_vertices);
  PreviewMesh mesh;
  if (uvs.rows() == 0 || topology.corner_uvs.empty()) {
    mesh.vertices = reduced.vertices;
    mesh.triangles = reduced.triangles;
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) mesh.twins.push_back(v);
    return mesh;
  }
  const auto rows = uvs_of(reduced.vertices, topology);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> split;  // (vertex, uv)
  std::vector<std::uint32_t> first(reduced.vertices.size(), kNoIndex);
  const auto vertex_at = [&](std::uint32_t vertex, std::uint32_t uv) {
    const auto number = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto [found, is_new] = split.try_emplace({vertex, uv}, number);
    if (!is_new) return found->second;
    if (first[vertex] == kNoIndex) first[vertex] = number;
    mesh.vertices.push_back(reduced.vertices[vertex]);
    mesh.twins.push_back(first[vertex]);
    for (int axis = 0; axis < 2; ++axis) {
      mesh.uvs.push_back(uv == kNoIndex ? 0.0F : static_cast<float>(uvs(uv, axis)));
    }
    return number;
  };
  for (std::size_t t = 0; t < reduced.triangles.size(); t += 3) {
    std::array<const std::vector<std::uint32_t>*, 3> choices{};
    for (std::size_t c = 0; c < 3; ++c) {
      choices[c] = &rows[reduced.triangles[t + c]];
    }
    const Corners rows_of = closest_uvs(uvs, choices);
    for (std::size_t c = 0; c < 3; ++c) {
      mesh.triangles.push_back(vertex_at(reduced.triangles[t + c], rows_of[c]));
    }
  }
  return mesh;
}

}  // namespace crowdface
