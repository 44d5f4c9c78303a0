// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/mesh/median_split_tree.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// A place on a triangle mesh.
struct SurfaceHit {
  std::uint32_t triangle = kNoIndex;  ///< kNoIndex: there is none
  std::array<double, 3> shares = {};  ///< barycentric, not negative, of sum one
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double distance = 0;
};

/// The place of one triangle nearest to a point (Ericson 2005, "Real-Time Collision Detection", 5.1.5).
SurfaceHit nearest_on_triangle(const Positions& positions, const Triangle& corners,
                               const Eigen::Vector3d& point);

/// A tree of boxes over triangles, to be asked from any thread for the surface nearest to a point. The
/// same answer, bit for bit, however it is asked.
class SurfaceTree {
 public:
  /// \param positions, triangles  must outlive the tree; triangles without area are left out.
  SurfaceTree(const Positions& positions, const std::vector<Triangle>& triangles);

  /// The nearest place within `reach`; of equally near ones that of the smallest triangle number.
  /// \param guess  a triangle that may be the one, or kNoIndex: a good guess saves most of the search.
  SurfaceHit nearest(const Eigen::Vector3d& point, double reach,
                     std::uint32_t guess = kNoIndex) const;
  /// The same among triangles that face the way `facing` (unit) does: the angle to the mean of the
  /// normals of their corners, in which noise and the edges of creases are evened out, is at most the
  /// one with this cosine.
  SurfaceHit nearest_facing(const Eigen::Vector3d& point, const Eigen::Vector3d& facing,
                            double least_cosine, double reach,
                            std::uint32_t guess = kNoIndex) const;

 private:
  /// That of one triangle; none beyond the reach.
  SurfaceHit on_triangle(std::uint32_t triangle, const Eigen::Vector3d& point, double reach) const;
  template <class Accept>
  SurfaceHit search(const Eigen::Vector3d& point, const SurfaceHit& start,
                    const Accept& accept) const;

  const Positions& positions_;
  const std::vector<Triangle>& triangles_;
  std::vector<Eigen::Vector3d> facing_;     ///< of each triangle
  MedianSplitTree tree_;                    ///< of the triangles with an area
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< of each node
};

}  // namespace crowdface
