// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/skin_check.h"

#include <mutex>

namespace crowdface {

struct SkinCheck::Target {
  std::once_flag once;
  std::unique_ptr<NewIntersections> intersections;
};

SkinCheck::SkinCheck(const Topology& topology, const Components& components,
                     const std::vector<Head>& heads)
    : heads_(heads), triangles_(triangles_of(topology, components, components.largest())) {
  for (std::size_t h = 0; h < heads.size(); ++h) targets_.push_back(std::make_unique<Target>());
}

SkinCheck::~SkinCheck() = default;

const SkinCheck::Target& SkinCheck::target(Index head) const {
  Target& target = *targets_[static_cast<std::size_t>(head)];
  std::call_once(target.once, [&] {
    const Positions& positions = heads_[static_cast<std::size_t>(head)].positions;
    target.intersections = std::make_unique<NewIntersections>(
        triangles_, positions.rows(),
        intersecting(triangles_, positions, near_pairs(triangles_, positions, 0)));
  });
  return target;
}

SkinDefects SkinCheck::compare(const Positions& positions, Index head,
                               double least_area_share) const {
  SkinDefects defects;
  defects.local = local_defects(triangles_, positions,
                                heads_[static_cast<std::size_t>(head)].positions, least_area_share);
  defects.new_intersections = target(head).intersections->count(
      intersecting(triangles_, positions, near_pairs(triangles_, positions, 0)));
  return defects;
}

}  // namespace crowdface
