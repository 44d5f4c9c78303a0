// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "crowdface/mesh/mirror_map.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {

/// Fits a mirror plane to points and their partners. The normal is the principal direction of the
/// differences between point and partner. The plane contains the mean of the midpoints between
/// point and partner.
class PlaneFit {
 public:
  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& partner);
  /// Returns the plane; needs at least one pair.
  ///
  /// \param side  Vector into the half space to which the normal points.
  MirrorPlane plane(const Eigen::Vector3d& side) const;
  /// Returns the number of pairs added so far.
  std::size_t pair_count() const { return pair_count_; }

 private:
  /// Σ d dᵀ over all pairs, where d is the difference between point and partner
  Eigen::Matrix3d scatter_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d midpoint_sum_ = Eigen::Vector3d::Zero();
  std::size_t pair_count_ = 0;
};

/// Finds the plane in which a surface is most nearly symmetric, by iterative closest points (Besl &
/// McKay 1992) with a reflection. The iteration runs twice, with different start planes. The first
/// start plane is `start`. The second start plane is fitted to pairs of vertices: each vertex and
/// the vertex that is nearest to its mirror image. For a symmetric mesh, the second start plane is
/// exact. Returns the best plane of all steps.
///
/// \param mean   Positions of the mean head, #V by 3.
/// \param skin   The surface's vertices; at least one.
/// \param start  First guess. Its normal is a unit vector along the head's side axis: towards the
///               left or the right ear.
MirrorPlane find_mirror_plane(const Topology& topology, const VertexFaces& vertex_faces,
                              const Positions& mean, const std::vector<std::uint32_t>& skin,
                              const MirrorPlane& start);

}  // namespace crowdface
