// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/mirror_map.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {

/// The plane that pairs of points and their partners' places tell: what joins two is along its normal,
/// and their middle is on it.
class PlaneFit {
 public:
  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& partner);
  /// Of at least one pair. \param side  the half space that the normal points to
  MirrorPlane plane(const Eigen::Vector3d& side) const;
  double count() const { return count_; }

 private:
  Eigen::Matrix3d along_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d middles_ = Eigen::Vector3d::Zero();
  double count_ = 0;
};

/// The plane on which a surface most nearly falls onto itself (Besl & McKay 1992, for a reflection): the best
/// that is met on the way from a first guess, and from where vertices that are nearest to each other's
/// images lead from there: of a symmetric mesh the very plane.
/// \param mean   #V by 3
/// \param skin   the surface's vertices, at least one
/// \param start  its normal is a unit vector from the head's right to its left, or the other way
MirrorPlane find_mirror_plane(const Topology& topology, const FacesAround& around,
                              const Positions& mean, const std::vector<std::uint32_t>& skin,
                              const MirrorPlane& start);

}  // namespace crowdface
