// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/attach/fitted_skin.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/point_grid.h"

namespace crowdface {

/// Some of the points, none within the other's distance, and all others within that of one: a share of how far they
/// hear the skin.
struct BendPlaces {
  static constexpr double kApart = 0.3;
  /// How far points hear a place, in such distances.
  static constexpr double kHeard = 2;

  std::vector<std::uint32_t> points;
  std::vector<FittedSkin::Patch> patches;
};

BendPlaces find_places(const FittedSkin& skin, const Positions& points, const PointGrid& grid);

/// Calls visit(point, weight) for all points that hear a place.
template <class Visit>
void visit_hearers(const Positions& points, const PointGrid& grid, const BendPlaces& places,
                   std::size_t place, const Visit& visit) {
  const Eigen::Vector3d middle = row3(points, places.points[place]);
  const double heard = BendPlaces::kHeard * BendPlaces::kApart * places.patches[place].reach;
  for (const std::uint32_t p : grid.about(middle, heard)) {
    const double distance = length3(row3(points, p) - middle) / heard;
    const double rest = 1 - distance * distance;
    if (rest > 0) visit(p, rest * rest);
  }
}

}  // namespace crowdface
