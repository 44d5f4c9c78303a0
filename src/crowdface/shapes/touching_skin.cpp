// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/touching_skin.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/point_grid.h"

namespace crowdface {
namespace {

// Lengths are fractions of the skin's extent, about 430 mm. Skin at two vertices may touch on a
// face only if their distance, on the template with the shape applied, is at most the larger of two
// limits: kMaxContactGap, and kMaxContactGapEdges times the longest edge at the vertex.
constexpr double kMaxContactGap = 0.02;
constexpr double kMaxContactGapEdges = 1.6;
/// The distance between the two vertices must also be at most
/// kMoveFactor · a + kDifferenceFactor · b. Here a is the length of the larger of the two vertices'
/// displacements, and b is the length of the difference between the two displacements.
constexpr double kMoveFactor = 4, kDifferenceFactor = 10;
// the skin folds at an edge if the displacements of the edge's ends differ by more than this
// fraction of the edge's length
constexpr double kFoldStrain = 0.5;
// Size of a grid cell, as a fraction of the skin's extent. If vertices in one cell have similar
// normals, only one of them is checked.
constexpr double kContactCell = 0.003;

/// Groups the vertices of the skin: a group has the vertices with similar normals in one cell of a
/// grid. Returns, for each vertex of the skin, the vertex that represents its group; kNoIndex for
/// vertices that are not skin.
/// \param cell  side of a grid cell
std::vector<std::uint32_t> representatives(const SkinTriangles& skin, const Positions& shaped,
                                           const Positions& normals, double cell) {
  using Cell = std::tuple<std::int64_t, std::int64_t, std::int64_t, Index, bool>;
  std::vector<std::pair<Cell, std::uint32_t>> placed;
  for (const std::uint32_t v : skin.vertices) {
    const auto at = [&](Index c) {
      return static_cast<std::int64_t>(std::floor(shaped(v, c) / cell));
    };
    Index axis = 0;
    normals.row(v).cwiseAbs().maxCoeff(&axis);
    placed.push_back({{at(0), at(1), at(2), axis, normals(v, axis) > 0}, v});
  }
  std::ranges::sort(placed);
  std::vector<std::uint32_t> representative(static_cast<std::size_t>(shaped.rows()), kNoIndex);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const auto& [at, v] = placed[i];
    const bool is_first = i == 0 || at != placed[i - 1].first;
    representative[v] = is_first ? v : representative[placed[i - 1].second];
  }
  return representative;
}

}  // namespace

std::vector<bool> skin_that_may_touch(const SkinTriangles& skin, const Positions& neutral,
                                      const Positions& shaped, double extent) {
  const Positions normals = vertex_normals_or_zero(skin.triangles, shaped);
  const std::vector<std::uint32_t> representative =
      representatives(skin, shaped, normals, kContactCell * extent);
  std::vector<std::uint32_t> asked;
  for (const std::uint32_t v : skin.vertices) {
    if (representative[v] == v) asked.push_back(v);
  }
  const auto move_of = [&](std::uint32_t v) -> Eigen::Vector3d {
    return row3(shaped, v) - row3(neutral, v);
  };
  const PointGrid grid(shaped, asked);
  std::vector<bool> meets(representative.size(), false), folds = meets;
  for (const std::uint32_t v : skin.vertices) {
    const Eigen::Vector3d at = row3(shaped, v), move = move_of(v);
    if (move.squaredNorm() == 0) continue;
    double reach = kMaxContactGap * extent;
    for (const std::uint32_t t : skin.vertex_triangles.items_of(v)) {
      for (const std::uint32_t w : skin.triangles[t]) {
        const double edge = (row3(shaped, w) - at).norm();
        reach = std::max(reach, kMaxContactGapEdges * edge);
        const double shorter = std::min(edge, (row3(neutral, w) - row3(neutral, v)).norm());
        if ((move_of(w) - move).norm() > kFoldStrain * shorter) folds[v] = folds[w] = true;
      }
    }
    if (representative[v] != v) continue;
    for (const std::uint32_t w : grid.vertices_near(at, reach)) {
      if ((meets[v] && meets[w]) || row3(normals, w).dot(row3(normals, v)) > 0) continue;
      const double distance = (row3(shaped, w) - at).norm();
      if (distance > reach) continue;
      const Eigen::Vector3d other = move_of(w);
      const double may_differ = kMoveFactor * std::max(move.norm(), other.norm()) +
                                kDifferenceFactor * (move - other).norm();
      if (may_differ >= distance) meets[v] = meets[w] = true;
    }
  }
  for (const std::uint32_t v : skin.vertices) meets[v] = meets[representative[v]] || folds[v];
  return meets;
}

}  // namespace crowdface
