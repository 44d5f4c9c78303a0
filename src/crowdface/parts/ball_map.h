// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {

/// How far the surface of an eyeball is from its centre, cornea and all, in directions around the
/// front: a grid over the stereographic plane, so that the gap to a lid costs a look-up instead of a
/// search.
class BallMap {
 public:
  BallMap() = default;
  /// \param vertices        of the eyeball's surface
  /// \param centre, radius  of its ball
  BallMap(const Topology& topology, const FacesAround& faces, const Positions& head,
          std::span<const std::uint32_t> vertices, const Eigen::Vector3d& centre, double radius,
          const HeadAxes& axes);

  struct Gap {
    double gap = 0;          ///< to the surface; negative inside
    Eigen::Vector3d normal;  ///< outward, unit
  };
  /// \param from  a point less the centre
  Gap gap_at(const Eigen::Vector3d& from) const;

  const Eigen::Vector3d& centre() const { return centre_; }
  double radius() const { return radius_; }
  /// The largest distance of the surface from the centre.
  double farthest() const { return farthest_; }

 private:
  /// Nodes along one side: half a millimetre apart at an eyeball's equator, one at its front.
  static constexpr std::size_t kNodes = 72;
  /// The plane's half width: a direction 16° behind the equator.
  static constexpr double kWidth = 1.32;

  float at(std::size_t x, std::size_t y) const { return radii_[y * kNodes + x]; }

  HeadAxes axes_;
  Eigen::Vector3d side_ = Eigen::Vector3d::Zero(), centre_ = Eigen::Vector3d::Zero();
  double radius_ = 0, farthest_ = 0;
  std::vector<float> radii_;  ///< kNodes by kNodes, x along the side axis first
};

}  // namespace crowdface
