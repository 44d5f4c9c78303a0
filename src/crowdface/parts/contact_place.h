// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/facing_skin.h"

namespace crowdface {

/// A point on an edge of a mesh: the same part of the way from a to b in every head.
struct EdgePoint {
  std::uint32_t a, b;
  double share;  ///< of b
};

/// A place where a gap is measured: two short profiles, cut across the two sides on the mean head, and
/// the direction that separates them there.
struct ContactPlace {
  Eigen::Vector3d middle, up;  ///< on the mean head; unit, from the low side to the high one
  Eigen::Vector3d along;       ///< unit: normal to the cut
  std::vector<EdgePoint> low, high;

  /// How far the lowest point of the high profile is above the highest of the low one; negative where
  /// they overlap.
  double gap(const Positions& positions) const;
  /// Unit: into the contact, within the cut.
  Eigen::Vector3d deep() const { return cross3(along, up); }
};

/// Places evenly spread over a group, without profiles.
/// \param spacing  at least so far from each other; none of the group's pairs is farther from all
std::vector<ContactPlace> places_among(const FacingGroup& group, double spacing);

/// Cuts the profiles of a place, some may be empty.
/// \param vertices  those around the group
/// \param side      #V: positive on the high side, negative on the low one
/// \param reach     of the profiles, from the place's middle
void cut_profiles(const Adjacency& adjacency, const Positions& mean,
                  std::span<const std::uint32_t> vertices, const std::vector<double>& side,
                  double reach, ContactPlace& place);

/// Of an edge's point above the origin, along a direction.
inline double height_of(const EdgePoint& point, const Eigen::Vector3d& up,
                        const Positions& positions) {
  const auto of = [&](std::uint32_t v) {
    return positions(v, 0) * up.x() + positions(v, 1) * up.y() + positions(v, 2) * up.z();
  };
  return (1 - point.share) * of(point.a) + point.share * of(point.b);
}

}  // namespace crowdface
