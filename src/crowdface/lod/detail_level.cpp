// SPDX-License-Identifier: Apache-2.0
#include "crowdface/lod/detail_level.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/preview/reduced_mesh.h"
#include "crowdface/preview/split_mesh.h"

namespace crowdface {
namespace {

DetailLevel level_of(const SplitMesh& split, std::vector<Triangle> triangles,
                     const HeadSet& heads) {
  triangles = grouped_by_material(std::move(triangles), split);
  DetailLevel level;
  std::vector<std::uint32_t> vertices, uvs;
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t corner : triangle) {
      vertices.push_back(split.corners[corner].vertex);
      uvs.push_back(split.corners[corner].uv);
    }
    level.source_faces.push_back(split.first_face_of_material[split.corners[triangle[0]].material]);
  }
  level.vertices = renumber(vertices, heads.topology.vertex_count);
  level.topology.vertex_count = static_cast<Index>(level.vertices.size());
  level.topology.corner_vertices = std::move(vertices);
  for (std::uint32_t t = 1; t <= triangles.size(); ++t) {
    // face_offsets already contains the 0 with which it starts
    level.topology.face_offsets.push_back(3 * t);
  }
  if (heads.topology.corner_uvs.empty()) return level;
  std::vector<std::uint32_t> used;
  std::copy_if(uvs.begin(), uvs.end(), std::back_inserter(used),
               [](std::uint32_t uv) { return uv != kNoIndex; });
  const std::vector<std::uint32_t> rows = renumber(used, heads.uvs.rows());
  level.uvs = heads.uvs(rows, kAllColumns);
  for (std::size_t c = 0, next = 0; c < uvs.size(); ++c) {
    if (uvs[c] != kNoIndex) uvs[c] = used[next++];
  }
  level.topology.corner_uvs = std::move(uvs);
  return level;
}

}  // namespace

Positions DetailLevel::restrict_rows(const Positions& whole) const {
  return whole(vertices, kAllColumns);
}

Displacements DetailLevel::restrict_rows(const Displacements& whole) const {
  Displacements some;
  std::vector<std::uint32_t> rows;
  auto next = whole.vertices.begin();
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    next = std::lower_bound(next, whole.vertices.end(), vertices[v]);
    if (next == whole.vertices.end()) break;
    if (*next != vertices[v]) continue;
    some.vertices.push_back(v);
    rows.push_back(static_cast<std::uint32_t>(next - whole.vertices.begin()));
  }
  some.moves = whole.moves(rows, kAllColumns);
  return some;
}

std::vector<DetailLevel> detail_levels(const HeadSet& heads,
                                       std::span<const std::uint32_t> materials,
                                       std::span<const double> shares, Borders borders) {
  const SplitMesh split = split_mesh(heads.topology, heads.uvs, materials);
  const Positions positions = split.corner_positions(mean_head(heads));
  std::vector<DetailLevel> levels(shares.size());
  parallel_for_each(shares.size(), [&](std::size_t l) {
    const double most = shares[l] * static_cast<double>(split.triangles.size());
    levels[l] = level_of(split,
                         reduce_triangles(split.triangles, positions,
                                          static_cast<std::size_t>(std::round(most)), borders),
                         heads);
    levels[l].share = shares[l];
  });
  return levels;
}

}  // namespace crowdface
