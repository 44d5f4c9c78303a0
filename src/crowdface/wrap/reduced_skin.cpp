// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/reduced_skin.h"

#include <algorithm>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/edge_distances.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/preview/reduced_mesh.h"
#include "crowdface/smooth/iterate.h"
#include "crowdface/wrap/shape_fit.h"
#include "crowdface/wrap/surface_tree.h"

namespace crowdface {

namespace {

/// Finds the closest point of the reduced skin to each vertex of the original skin. First finds the
/// vertex of the reduced skin that is nearest along the surface. Then searches only the triangles
/// around this vertex and around its neighbours. The closest point in space may lie on another part
/// of the skin, because lips touch and nostrils have thin walls.
std::vector<ReducedSkin::BarycentricPoint> find_barycentric_points(const SkinMesh& skin,
                                                                   const Positions& positions,
                                                                   const SkinMesh& small) {
  const Positions corners = small.rows_of(positions);
  const VertexFaces around(topology_of(small.triangles, small.vertex_count()));
  const std::vector<std::uint32_t> source =
      nearest_along_edges(skin.adjacency, positions, small.vertices);
  const SurfaceTree tree(corners, small.triangles);
  std::vector<ReducedSkin::BarycentricPoint> vertex_positions(skin.vertices.size());
  parallel_for_each(positions.rows(), 1024, [&](Index v) {
    const Eigen::Vector3d point = row3(positions, v);
    SurfaceHit best;
    best.distance = 1e300;
    const auto look_around = [&](std::uint32_t vertex) {
      for (const std::uint32_t t : around.items_of(vertex)) {
        SurfaceHit hit = nearest_on_triangle(corners, small.triangles[t], point);
        hit.triangle = t;
        if (hit.distance < best.distance) best = hit;
      }
    };
    if (const std::uint32_t from = source[static_cast<std::size_t>(v)]; from != kNoIndex) {
      look_around(from);
      for (const std::uint32_t n : small.adjacency.items_of(from)) look_around(n);
    }
    if (best.triangle == kNoIndex) best = tree.nearest(point, 1e300);
    auto& place = vertex_positions[static_cast<std::size_t>(v)];
    place.triangle = best.triangle;
    for (std::size_t k = 0; k < 3; ++k)
      place.barycentric[k] = static_cast<float>(best.barycentric[k]);
  });
  return vertex_positions;
}

}  // namespace

Positions ReducedSkin::interpolate(const Positions& values, const SkinMesh& large) const {
  Columns carried(static_cast<Index>(vertex_positions.size()), 3);
  for (std::size_t v = 0; v < vertex_positions.size(); ++v) {
    const Triangle& corners = mesh.triangles[vertex_positions[v].triangle];
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      sum += vertex_positions[v].barycentric[k] * values.row(corners[k]);
    carried.row(static_cast<Index>(v)) = sum;
  }
  const SmoothingOperator lazy(large.adjacency, Boundary::kFree, OperatorKind::kLazy);
  return iterate(lazy, carried, static_cast<std::uint64_t>(smoothing_steps));
}

std::vector<double> ReducedSkin::interpolate(const std::vector<double>& values) const {
  std::vector<double> carried(vertex_positions.size(), 0.0);
  for (std::size_t v = 0; v < vertex_positions.size(); ++v) {
    const Triangle& corners = mesh.triangles[vertex_positions[v].triangle];
    for (std::size_t k = 0; k < 3; ++k)
      carried[v] += vertex_positions[v].barycentric[k] * values[corners[k]];
  }
  return carried;
}

ReducedSkin reduce_skin(const SkinMesh& skin, const Positions& positions,
                        std::size_t vertex_count) {
  const ReducedMesh small = reduce_mesh(skin.triangles, positions, 2 * vertex_count);
  ReducedSkin reduced;
  reduced.mesh.vertices = small.vertices;
  reduced.mesh.triangles = small.triangles;
  reduced.mesh.adjacency = build_adjacency(
      topology_of(reduced.mesh.triangles, static_cast<Index>(small.vertices.size())));
  reduced.vertex_positions = find_barycentric_points(skin, positions, reduced.mesh);
  // Choose the number of smoothing steps. One step acts over half an edge of the original skin. All
  // steps together must smooth creases at the edges of the reduced skin, which are longer than the
  // edges of the original skin.
  const auto ratio = static_cast<double>(skin.vertices.size()) /
                     static_cast<double>(std::max<std::size_t>(1, small.vertices.size()));
  reduced.smoothing_steps = static_cast<int>(std::clamp(ratio, 2.0, 120.0));
  return reduced;
}

}  // namespace crowdface
