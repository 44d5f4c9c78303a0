// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {

/// Which way a head looks: unit vectors.
struct HeadAxes {
  Eigen::Vector3d front = {0, 0, 1}, up = {0, 1, 0};
};

/// The rim of an eyeball's lids: of the skin close to the eyeball, in each of some directions around
/// its axis, the vertex that comes nearest to the axis.
struct Lids {
  std::vector<std::uint32_t> vertices;  ///< ascending
  std::vector<bool> upper;              ///< #vertices: of the upper lid
};

/// \param eyeball         vertices of the eyeball
/// \param centre, radius  of the eyeball
/// \param skin            the skin's vertices
Lids find_lids(const Positions& positions, const PointGrid& eyeball, const Eigen::Vector3d& centre,
               double radius, const HeadAxes& axes, std::span<const std::uint32_t> skin);

/// An eyeball as it stands in one head, and how far the lids are off it.
class Eyeball {
 public:
  /// \param vertices        of the eyeball
  /// \param centre, radius  of its ball in this head
  /// Topology, faces and head must outlive it.
  Eyeball(const Topology& topology, const FacesAround& faces, const Positions& head,
          std::span<const std::uint32_t> vertices, const Eigen::Vector3d& centre, double radius,
          const Lids& lids);

  /// #lids; negative inside the eyeball.
  const std::vector<double>& gaps() const { return gaps_; }

  /// How to shift the eyeball after it has moved, so that its mean gap to each lid becomes what it was,
  /// and each gap of the rim as nearly as it then can (weighted least squares by Gauss and Newton).
  Eigen::Vector3d shift_into(const Lids& lids, const RigidMotion& motion,
                             const Positions& after) const;

 private:
  /// Centre of the ball of our radius that touches the eyeball from inside where a point is nearest.
  Eigen::Vector3d ball_under(const Eigen::Vector3d& point) const;
  Eigen::Vector3d step(const Lids& lids, const std::vector<Eigen::Vector3d>& balls, double radius,
                       const Eigen::Vector3d& shift, const Positions& after) const;

  const Topology& topology_;
  const FacesAround& faces_;
  const Positions& head_;
  PointGrid grid_;
  Eigen::Vector3d centre_;
  double radius_;
  std::vector<double> gaps_;
};

}  // namespace crowdface
