// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/skin_check.h"

namespace crowdface {

SkinCheck::SkinCheck(const Topology& topology, const Components& components,
                     const std::vector<Head>& heads, const std::set<Index>& targets)
    : triangles_(triangles_of(topology, components, components.largest())) {
  for (const Index target : targets) {
    targets_.emplace(target, prepared(heads[static_cast<std::size_t>(target)].positions));
  }
}

SkinCheck::Target SkinCheck::prepared(const Positions& positions) const {
  const auto pairs = intersecting(triangles_, positions, near_pairs(triangles_, positions, 0));
  return {TargetTriangles(triangles_, positions),
          NewIntersections(triangles_, positions.rows(), pairs)};
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
  defects.intersecting = target.intersections.count(
      intersecting(triangles_, positions, near_pairs(triangles_, positions, 0)));
  return defects;
}

std::uint64_t SkinCheck::memory_bytes() const {
  std::uint64_t bytes = triangles_.size() * sizeof(Triangle);
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
