// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/ties.h"

#include <algorithm>

#include "crowdface/parts/point_grid.h"

namespace crowdface {

Ties::Ties(const Positions& positions, const std::vector<std::span<const std::uint32_t>>& rigid,
           std::span<const std::uint32_t> bound, double reach) {
  std::vector<PointGrid> grids;
  grids.reserve(rigid.size());
  for (const auto& vertices : rigid) grids.emplace_back(positions, vertices);
  for (const std::uint32_t v : bound) {
    const std::size_t first = ties_.size();
    double sum = 0;
    for (std::uint32_t part = 0; part < grids.size(); ++part) {
      const auto nearest = grids[part].nearest(positions.row(v).transpose(), reach);
      if (nearest.vertex == kNoIndex) continue;
      const double t = nearest.distance / reach;
      const double share = (1 - t * t) * (1 - t * t);
      ties_.push_back({v, part, share});
      sum += share;
    }
    // Between two parts a vertex goes with both.
    for (std::size_t i = first; i < ties_.size(); ++i) ties_[i].share /= std::max(1.0, sum);
  }
}

void Ties::pull(const Positions& target, std::span<const RigidMotion> motions,
                Positions& result) const {
  for (std::size_t i = 0; i < ties_.size();) {
    const std::uint32_t v = ties_[i].vertex;
    const Eigen::Vector3d bound = result.row(v).transpose();
    Eigen::Vector3d change = Eigen::Vector3d::Zero();
    for (; i < ties_.size() && ties_[i].vertex == v; ++i) {
      change += ties_[i].share * (motions[ties_[i].part].apply(target.row(v).transpose()) - bound);
    }
    result.row(v) = (bound + change).transpose();
  }
}

}  // namespace crowdface
