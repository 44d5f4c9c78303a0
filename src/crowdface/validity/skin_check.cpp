// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/skin_check.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

const Head& first_of(const std::vector<Head>& heads) {
  require(!heads.empty(), "skin is checked against heads, and there is none");
  return heads.front();
}

/// Margin of the bounding boxes, so that no ray misses a box through rounding.
double margin_of(const Positions& positions) {
  return 1e-5 * (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).maxCoeff();
}

/// Orients the skin's triangles so that their normals point outwards: flips all if the enclosed
/// volume is negative.
std::vector<Triangle> outward(std::vector<Triangle> triangles, const Positions& head) {
  if (triangles.empty()) return triangles;
  const Eigen::Vector3d origin = row3(head, triangles.front()[0]);
  double volume = 0;
  for (const Triangle& triangle : triangles) {
    volume += (row3(head, triangle[0]) - origin).dot(area_vector(head, triangle));
  }
  if (volume < 0) {
    for (Triangle& triangle : triangles) std::swap(triangle[1], triangle[2]);
  }
  return triangles;
}

/// A view of a back side counts only if the cosine between the direction to the viewer and the
/// normal of the back side exceeds this; at smaller cosines little is visible.
constexpr double kFlattestCosine = 0.2;
/// kSpacingMm: spacing of the visibility samples on a triangle. kMaxAlongEdge: largest
/// number of samples along an edge.
constexpr double kSpacingMm = 1;
constexpr int kMaxAlongEdge = 8;

int points_along_edge(const Corners& at, double mm_per_unit) {
  const double longest =
      std::max({(at[1] - at[0]).norm(), (at[2] - at[1]).norm(), (at[0] - at[2]).norm()});
  return std::clamp(static_cast<int>(longest * mm_per_unit / kSpacingMm), 1, kMaxAlongEdge);
}

/// The fraction of a triangle whose back side is visible to any viewer, sampled at the centroids of
/// n² equal subtriangles.
/// \param in_the_way  #directions: the last occluder found for each viewer, tested first for the
///                    next ray.
double exposed_share(const TriangleScene& scene, const Corners& at, std::uint32_t triangle,
                     const ViewSetup& view_setup, std::span<std::uint32_t> in_the_way) {
  const Eigen::Vector3d normal = (at[1] - at[0]).cross(at[2] - at[0]);
  std::vector<std::size_t> behind;
  for (std::size_t i = 0; i < view_setup.directions.size(); ++i) {
    const Eigen::Vector3d& viewer = view_setup.directions[i];
    if (-normal.dot(viewer) > kFlattestCosine * normal.norm() * viewer.norm()) {
      behind.push_back(i);
    }
  }
  if (behind.empty()) return 0;
  const int n = points_along_edge(at, view_setup.mm_per_unit);
  int shown = 0;
  const auto look_at = [&](int thirds_b, int thirds_c) {
    const double b = thirds_b / (3.0 * n), c = thirds_c / (3.0 * n);
    const Eigen::Vector3d point = (1 - b - c) * at[0] + b * at[1] + c * at[2];
    shown += std::ranges::any_of(behind, [&](std::size_t viewer) {
      std::uint32_t& other = in_the_way[viewer];
      other = scene.intersected_by(point, view_setup.directions[viewer], triangle, other);
      return other == kNoIndex;
    });
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      look_at(3 * i + 1, 3 * j + 1);
      if (i + j < n - 1) look_at(3 * i + 2, 3 * j + 2);
    }
  }
  return static_cast<double>(shown) / (n * n);
}

/// Returns the area of a skin's back side that is visible, in the positions' unit squared. The back
/// side shows where skin passes through other skin, such as the lining of a nostril through the
/// wing of the nose. The search begins at intersecting triangles and continues across triangles
/// with a visible back side, at samples about a millimetre apart.
/// \param around        the triangles at each vertex.
/// \param intersecting  pairs of intersecting triangles.
double exposed_back(const TriangleScene& scene, const std::vector<Triangle>& triangles,
                    const Positions& positions, const VertexFaces& around,
                    const std::vector<TrianglePair>& intersecting, const ViewSetup& view_setup) {
  std::vector<bool> seen(triangles.size(), false);
  std::vector<std::uint32_t> waiting;
  const auto look_around = [&](std::uint32_t triangle) {
    for (const std::uint32_t vertex : triangles[triangle]) {
      for (const std::uint32_t other : around.of(vertex)) {
        if (seen[other]) continue;
        seen[other] = true;
        waiting.push_back(other);
      }
    }
  };
  for (const auto& [a, b] : intersecting) {
    look_around(a);
    look_around(b);
  }
  std::vector<std::uint32_t> in_the_way(view_setup.directions.size(), kNoIndex);
  double exposed = 0;
  while (!waiting.empty()) {
    const std::uint32_t t = waiting.back();
    waiting.pop_back();
    const double share =
        exposed_share(scene, corners_of(positions, triangles[t]), t, view_setup, in_the_way);
    if (share == 0) continue;
    exposed += 0.5 * share * area_vector(positions, triangles[t]).norm();
    look_around(t);
  }
  return exposed;
}

/// The self-intersections of a skin, and the visible area of its back side.
struct Crossing {
  std::vector<TrianglePair> pairs;
  double exposed;
};

Crossing crossing_of(const std::vector<Triangle>& triangles, const TriangleTree& tree,
                     const Positions& positions, const VertexFaces& around,
                     const ViewSetup& view_setup) {
  const TriangleScene scene(triangles, tree, positions, margin_of(positions));
  std::vector<TrianglePair> pairs = scene.crossing_pairs();
  const double exposed = exposed_back(scene, triangles, positions, around, pairs, view_setup);
  return {std::move(pairs), exposed};
}

}  // namespace

SkinCheck::SkinCheck(const Topology& topology, const Components& components,
                     const std::vector<Head>& heads, const std::set<Index>& targets,
                     ViewSetup view_setup)
    : triangles_(outward(triangles_of(topology, components, components.largest()),
                         first_of(heads).positions)),
      tree_(triangles_, heads.front().positions),
      around_(topology_of(triangles_, topology.vertex_count)),
      view_setup_(std::move(view_setup)) {
  const std::vector<Index> asked(targets.begin(), targets.end());
  std::vector<std::optional<Target>> ready(asked.size());
  parallel_for_each(asked.size(), [&](std::size_t t) {
    ready[t] = prepared(heads[static_cast<std::size_t>(asked[t])].positions);
  });
  for (std::size_t t = 0; t < asked.size(); ++t) targets_.emplace(asked[t], std::move(*ready[t]));
}

SkinCheck::Target SkinCheck::prepared(const Positions& positions) const {
  const Crossing crossing = crossing_of(triangles_, tree_, positions, around_, view_setup_);
  return {TargetTriangles(triangles_, positions),
          NewIntersections(triangles_, positions.rows(), crossing.pairs), crossing.exposed};
}

SkinDefects SkinCheck::compare(const Positions& positions, Index target) const {
  return compare(positions, targets_.at(target));
}

SkinDefects SkinCheck::compare(const Positions& positions, const Positions& target) const {
  return compare(positions, prepared(target));
}

SkinDefects SkinCheck::compare(const Positions& positions, const Target& target) const {
  SkinDefects defects;
  defects.local = target.triangles.compare(positions);
  const Crossing crossing = crossing_of(triangles_, tree_, positions, around_, view_setup_);
  defects.intersecting = target.intersections.count(crossing.pairs);
  defects.exposed_mm2 = std::max(0.0, crossing.exposed - target.exposed) * view_setup_.mm_per_unit *
                        view_setup_.mm_per_unit;
  return defects;
}

std::uint64_t SkinCheck::memory_bytes() const {
  std::uint64_t bytes = triangles_.size() * (sizeof(Triangle) + 5 * sizeof(std::uint32_t)) +
                        tree_.nodes.size() * sizeof(TriangleTree::Node) +
                        tree_.corners.size() * sizeof(LeafCorners);
  for (const auto& [head, target] : targets_) {
    bytes += target.triangles.memory_bytes() + triangles_.size() / 8;
  }
  return bytes;
}

std::uint64_t SkinCheck::compare_bytes() const {
  // 120 bytes per triangle measured with 2.4 million triangles.
  constexpr std::uint64_t kBytesPerTriangle = 150;
  return kBytesPerTriangle * triangles_.size();
}

}  // namespace crowdface
