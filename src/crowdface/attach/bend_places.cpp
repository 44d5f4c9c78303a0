// SPDX-License-Identifier: Apache-2.0
#include "crowdface/attach/bend_places.h"

namespace crowdface {

BendPlaces find_places(const FittedSkin& skin, const Positions& points, const PointGrid& grid) {
  BendPlaces places;
  std::vector<bool> covered(static_cast<std::size_t>(points.rows()), false);
  for (std::uint32_t p = 0; p < covered.size(); ++p) {
    if (covered[p]) continue;
    const Eigen::Vector3d middle = row3(points, p);
    places.points.push_back(p);
    places.patches.push_back(skin.patch_around(middle));
    const double apart = BendPlaces::kApart * places.patches.back().reach;
    for (const std::uint32_t other : grid.about(middle, apart)) {
      if (length3(row3(points, other) - middle) < apart) covered[other] = true;
    }
    covered[p] = true;
  }
  return places;
}

}  // namespace crowdface
