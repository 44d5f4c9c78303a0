// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/skin_check.h"

#include <algorithm>
#include <utility>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

/// By which boxes are grown, so that rounding lets no ray miss one.
double margin_of(const Positions& positions) {
  return 1e-5 * (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).maxCoeff();
}

/// The skin's triangles, turned so that their normals point outwards, as the volume they hold tells.
std::vector<Triangle> outward(std::vector<Triangle> triangles, const Positions& head) {
  if (triangles.empty()) return triangles;
  const Eigen::Vector3d origin = row3(head, triangles.front()[0]);
  double volume = 0;
  for (const Triangle& triangle : triangles) {
    volume += dot3(row3(head, triangle[0]) - origin, area_vector(head, triangle));
  }
  if (volume < 0) {
    for (Triangle& triangle : triangles) std::swap(triangle[1], triangle[2]);
  }
  return triangles;
}

/// What of a skin passes through itself, and how much of its back shows there.
struct Crossing {
  std::vector<TrianglePair> pairs;
  double exposed;
};

Crossing crossing_of(const std::vector<Triangle>& triangles, const TriangleTree& tree,
                     const Positions& positions, const TriangleNeighbours& neighbours,
                     const Viewing& viewing) {
  const TriangleScene scene(triangles, tree, positions, margin_of(positions));
  std::vector<TrianglePair> pairs = intersecting(triangles, positions, scene.near_pairs());
  const double exposed = exposed_back(scene, triangles, positions, neighbours, pairs, viewing);
  return {std::move(pairs), exposed};
}

}  // namespace

SkinCheck::SkinCheck(const Topology& topology, const Components& components,
                     const std::vector<Head>& heads, const std::set<Index>& targets,
                     Viewing viewing)
    : triangles_(outward(triangles_of(topology, components, components.largest()),
                         heads.front().positions)),
      tree_(triangles_, heads.front().positions),
      neighbours_(triangles_, topology.vertex_count),
      viewing_(std::move(viewing)) {
  for (const Index target : targets) {
    targets_.emplace(target, prepared(heads[static_cast<std::size_t>(target)].positions));
  }
}

SkinCheck::Target SkinCheck::prepared(const Positions& positions) const {
  const Crossing crossing = crossing_of(triangles_, tree_, positions, neighbours_, viewing_);
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
  const Crossing crossing = crossing_of(triangles_, tree_, positions, neighbours_, viewing_);
  defects.intersecting = target.intersections.count(crossing.pairs);
  defects.exposed_mm2 = std::max(0.0, crossing.exposed - target.exposed) * viewing_.mm_per_unit *
                        viewing_.mm_per_unit;
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
  constexpr std::uint64_t kBytesATriangle = 150;  // 120 measured, on 2.4 million
  return kBytesATriangle * triangles_.size();
}

}  // namespace crowdface
