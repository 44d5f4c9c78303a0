// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {

/// The radius of an eyeball, including the cornea, for each direction around its front. A grid over
/// the stereographic plane stores the radii, so that a table look-up gives the gap between eyeball
/// and lid without a search.
class BallRadii {
 public:
  BallRadii() = default;
  /// \param vertices  Vertices of the eyeball's surface.
  /// \param centre    Centre of the eyeball.
  /// \param radius    Radius of the eyeball.
  BallRadii(const Topology& topology, const VertexFaces& faces, const Positions& head,
            std::span<const std::uint32_t> vertices, const Eigen::Vector3d& centre, double radius,
            const HeadAxes& axes);

  /// Gap between the eyeball's surface and a point.
  struct Gap {
    /// signed distance of the point from the eyeball's surface, in the unit of the head's
    /// positions; negative: the point is inside the eyeball
    double gap = 0;
    /// outward unit normal of the eyeball's surface, where the line from the eyeball's centre to
    /// the point meets the surface
    Eigen::Vector3d normal;
  };
  /// Returns the approximate gap between the surface and a point (exact to first order).
  ///
  /// \param centre_to_point  Vector from the eyeball's centre to the point.
  Gap gap_at(const Eigen::Vector3d& centre_to_point) const;

  const Eigen::Vector3d& centre() const { return centre_; }
  /// Returns the constructor's parameter `radius`: one radius for the whole eyeball.
  double radius() const { return radius_; }
  /// Returns the largest radius in any direction.
  double max_radius() const { return max_radius_; }

 private:
  /// Number of nodes along one side of the grid. Nodes are half a millimetre apart at an eyeball's
  /// equator, and one millimetre at its front.
  static constexpr std::size_t kNodesPerSide = 72;
  /// Half width of the grid in the stereographic plane; reaches 16° behind the equator.
  static constexpr double kHalfWidth = 1.32;

  /// Returns the eyeball's radius in the direction of a node of the grid.
  float radius_at_node(std::size_t x, std::size_t y) const { return radii_[y * kNodesPerSide + x]; }

  HeadAxes axes_;
  /// `side_`: the head's side axis. `centre_`: the centre of the eyeball.
  Eigen::Vector3d side_ = Eigen::Vector3d::Zero(), centre_ = Eigen::Vector3d::Zero();
  /// `radius_`: the constructor's parameter. `max_radius_`: the largest radius in any direction.
  double radius_ = 0, max_radius_ = 0;
  /// radius at each node of the grid; the node's x, along the side axis, varies fastest
  std::vector<float> radii_;
};

}  // namespace crowdface
