// SPDX-License-Identifier: Apache-2.0
#include "crowdface/preview/reduced_mesh.h"

#include <algorithm>
#include <utility>

#include <meshoptimizer.h>

#include "crowdface/core/require.h"

namespace crowdface {
namespace {

/// Collapses edges of a mesh, given as index triples, until at most `max_triangles` triangles are
/// left or no further edge can collapse.
///
/// \param options  flags of meshopt_simplify.
void reduce(std::vector<unsigned int>& triangles, const Positions& positions,
            std::size_t max_triangles, unsigned int options = 0) {
  if (triangles.size() <= 3 * max_triangles) return;
  const std::vector<float> points(positions.data(), positions.data() + positions.size());
  constexpr float kAnyError = 1e30F;  // stop at the target count, whatever the error
  triangles.resize(meshopt_simplify(triangles.data(), triangles.data(), triangles.size(),
                                    points.data(), points.size() / 3, 3 * sizeof(float),
                                    3 * max_triangles, kAnyError, options, nullptr));
}

std::vector<unsigned int> corners_of(const std::vector<Triangle>& triangles) {
  std::vector<unsigned int> corners;
  corners.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  return corners;
}

/// Converts index triples to triangles, and sorts the triangles for good use of the vertex cache of
/// a graphics card.
std::vector<Triangle> optimize_for_vertex_cache(std::vector<unsigned int> corners,
                                                Index vertex_count) {
  meshopt_optimizeVertexCache(corners.data(), corners.data(), corners.size(),
                              static_cast<std::size_t>(vertex_count));
  std::vector<Triangle> triangles(corners.size() / 3);
  for (std::size_t c = 0; c < corners.size(); ++c) triangles[c / 3][c % 3] = corners[c];
  return triangles;
}

}  // namespace

std::vector<Triangle> reduce_triangles(const std::vector<Triangle>& triangles,
                                       const Positions& positions, std::size_t max_triangles,
                                       Borders borders) {
  std::vector<unsigned int> corners = corners_of(triangles);
  const unsigned int options = borders == Borders::kKeep ? +meshopt_SimplifyLockBorder : 0U;
  reduce(corners, positions, max_triangles, options);
  return optimize_for_vertex_cache(std::move(corners), positions.rows());
}

ReducedMesh reduce_mesh(const std::vector<Triangle>& triangles, const Positions& positions,
                        std::size_t max_triangles) {
  ReducedMesh mesh;
  std::vector<std::uint32_t> number(static_cast<std::size_t>(positions.rows()), kNoIndex);
  for (Triangle triangle : reduce_triangles(triangles, positions, max_triangles)) {
    for (std::uint32_t& vertex : triangle) {
      if (number[vertex] == kNoIndex) {
        number[vertex] = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(vertex);
      }
      vertex = number[vertex];
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

std::vector<Triangle> reduce_hidden(const std::vector<Triangle>& triangles,
                                    const Positions& positions, const std::vector<bool>& hidden,
                                    std::size_t max_triangles, std::size_t max_hidden) {
  require(hidden.size() == triangles.size(), "reduce: ", hidden.size(), " marks, ",
          triangles.size(), " triangles");
  std::vector<Triangle> of_seen, of_unseen;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    (hidden[t] ? of_unseen : of_seen).push_back(triangles[t]);
  }
  std::vector<unsigned int> seen = corners_of(of_seen), unseen = corners_of(of_unseen);
  reduce(unseen, positions, max_hidden, meshopt_SimplifyLockBorder);
  reduce(seen, positions, max_triangles - std::min(max_triangles, unseen.size() / 3),
         meshopt_SimplifyLockBorder);
  seen.insert(seen.end(), unseen.begin(), unseen.end());
  return optimize_for_vertex_cache(std::move(seen), positions.rows());
}

}  // namespace crowdface
