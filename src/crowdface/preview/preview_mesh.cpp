// SPDX-License-Identifier: Apache-2.0
#include "crowdface/preview/preview_mesh.h"

#include <algorithm>
#include <map>
#include <utility>

#include "crowdface/core/require.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/preview/reduced_mesh.h"

namespace crowdface {

PreviewMesh preview_mesh(const Topology& topology, const TextureCoordinates& uvs,
                         const Positions& typical_positions, const std::vector<bool>& is_shown,
                         std::size_t max_vertices) {
  const auto faces = static_cast<std::size_t>(topology.face_count());
  require(is_shown.empty() || is_shown.size() == faces, "preview: ", is_shown.size(), " marks, ",
          faces, " faces");
  std::vector<std::uint32_t> labels(faces, 0);
  for (std::size_t f = 0; f < is_shown.size(); ++f) labels[f] = is_shown[f] ? 0 : kNoIndex;
  const SplitMesh split = split_mesh(topology, uvs, labels);
  return preview_from_split_mesh(
      split,
      reduce_triangles(split.triangles, split.corner_positions(typical_positions),
                       2 * max_vertices),
      uvs);
}

PreviewMesh preview_from_split_mesh(const SplitMesh& split, std::vector<Triangle> triangles,
                                    const TextureCoordinates& uvs) {
  triangles = grouped_by_material(std::move(triangles), split);
  const auto material_of_triangle = [&](const Triangle& t) { return split.corners[t[0]].material; };
  PreviewMesh mesh;
  std::vector<std::uint32_t> number(split.corners.size(), kNoIndex);
  // Maps each vertex of the whole mesh to the first preview vertex that is a copy of this vertex.
  std::map<std::uint32_t, std::uint32_t> first;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (t == 0 || material_of_triangle(triangles[t]) != material_of_triangle(triangles[t - 1])) {
      mesh.material_starts.push_back(static_cast<std::uint32_t>(t));
    }
    for (const std::uint32_t corner : triangles[t]) {
      if (number[corner] == kNoIndex) {
        const auto [vertex, uv, material] = split.corners[corner];
        number[corner] = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(vertex);
        mesh.face_of_vertex.push_back(split.face_of_corner[corner]);
        mesh.first_copy_of_vertex.push_back(first.emplace(vertex, number[corner]).first->second);
        for (int axis = 0; axis < 2 && uvs.rows() > 0; ++axis) {
          mesh.uvs.push_back(uv == kNoIndex ? 0.0F : static_cast<float>(uvs(uv, axis)));
        }
      }
      mesh.triangles.push_back(number[corner]);
    }
  }
  return mesh;
}

std::vector<std::uint32_t> draft_triangles(const PreviewMesh& mesh,
                                           const Positions& typical_positions,
                                           std::size_t max_triangles) {
  std::vector<Triangle> triangles(mesh.triangles.size() / 3);
  for (std::size_t c = 0; c < mesh.triangles.size(); ++c) {
    triangles[c / 3][c % 3] = mesh.triangles[c];
  }
  const Positions positions = typical_positions(mesh.vertices, kAllColumns);
  std::vector<std::uint32_t> draft;
  for (const Triangle& triangle : reduce_triangles(triangles, positions, max_triangles)) {
    draft.insert(draft.end(), triangle.begin(), triangle.end());
  }
  return draft;
}

}  // namespace crowdface
