// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/reduced_skin.h"

#include <algorithm>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/preview/reduced_mesh.h"
#include "crowdface/smooth/iterate.h"
#include "crowdface/wrap/shape_fit.h"
#include "crowdface/wrap/surface_tree.h"

namespace crowdface {

Positions ReducedSkin::carry(const Positions& values, const SkinMesh& large) const {
  Columns carried(static_cast<Index>(places.size()), 3);
  for (std::size_t v = 0; v < places.size(); ++v) {
    const Triangle& corners = mesh.triangles[places[v].triangle];
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) sum += places[v].shares[k] * values.row(corners[k]);
    carried.row(static_cast<Index>(v)) = sum;
  }
  const SmoothingOperator lazy(large.adjacency, Boundary::kFree, OperatorKind::kLazy);
  return iterate(lazy, carried, static_cast<std::uint64_t>(smoothings));
}

std::vector<double> ReducedSkin::carry(const std::vector<double>& values) const {
  std::vector<double> carried(places.size(), 0.0);
  for (std::size_t v = 0; v < places.size(); ++v) {
    const Triangle& corners = mesh.triangles[places[v].triangle];
    for (std::size_t k = 0; k < 3; ++k) carried[v] += places[v].shares[k] * values[corners[k]];
  }
  return carried;
}

ReducedSkin reduce_skin(const SkinMesh& skin, const Positions& positions, std::size_t vertices) {
  const ReducedMesh small =
      reduce_mesh(topology_of(skin.triangles, positions.rows()), positions, {}, 2 * vertices);
  ReducedSkin reduced;
  reduced.mesh.vertices = small.vertices;
  for (std::size_t i = 0; i + 2 < small.triangles.size(); i += 3) {
    reduced.mesh.triangles.push_back(
        {small.triangles[i], small.triangles[i + 1], small.triangles[i + 2]});
  }
  reduced.mesh.adjacency = build_adjacency(
      topology_of(reduced.mesh.triangles, static_cast<Index>(small.vertices.size())));
  // Lips touch: a vertex of one must not hang on the other, so that the sides must agree.
  const Positions normals = vertex_normals(skin.triangles, positions),
                  places = reduced.mesh.of(positions);
  const SurfaceTree tree(places, reduced.mesh.triangles);
  reduced.places.resize(skin.vertices.size());
  parallel_for_each(positions.rows(), 1024, [&](Index v) {
    const Eigen::Vector3d point = row3(positions, v);
    SurfaceHit hit = tree.nearest_facing(point, row3(normals, v), 0.3, 1e300);
    if (hit.triangle == kNoIndex) hit = tree.nearest(point, 1e300);
    auto& place = reduced.places[static_cast<std::size_t>(v)];
    place.triangle = hit.triangle;
    for (std::size_t k = 0; k < 3; ++k) place.shares[k] = static_cast<float>(hit.shares[k]);
  });
  // One smoothing reaches half an edge; the creases of what is carried are an edge of the small skin
  // apart.
  const auto ratio = static_cast<double>(skin.vertices.size()) /
                     static_cast<double>(std::max<std::size_t>(1, small.vertices.size()));
  reduced.smoothings = static_cast<int>(std::clamp(ratio, 2.0, 120.0));
  return reduced;
}

}  // namespace crowdface
