// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/mesh/median_split_tree.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// A point on a triangle mesh.
struct SurfaceHit {
  std::uint32_t triangle = kNoIndex;       ///< index of the triangle; kNoIndex: nothing found
  std::array<double, 3> barycentric = {};  ///< barycentric coordinates, not negative, with sum 1
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< the point on the mesh
  double distance = 0;                              ///< distance of this point from the query point
};

/// The point of a triangle closest to `point` (Ericson 2005, "Real-Time Collision Detection",
/// 5.1.5).
SurfaceHit nearest_on_triangle(const Positions& positions, const Triangle& corners,
                               const Eigen::Vector3d& point);

/// A bounding-volume tree over triangles for closest-point queries. Thread-safe. The parameter
/// `guess` of the queries and the number of threads change only the speed: the results always have
/// the same bits.
class SurfaceTree {
 public:
  /// \param positions, triangles  must outlive the tree; triangles without area are left out.
  SurfaceTree(const Positions& positions, const std::vector<Triangle>& triangles);

  /// The closest point within the distance `reach`. Of equally close points, returns the point on
  /// the triangle with the smallest index.
  /// \param guess  index of a triangle that is probably the closest, or kNoIndex. A good guess
  ///               makes the search much faster.
  SurfaceHit nearest(const Eigen::Vector3d& point, double reach,
                     std::uint32_t guess = kNoIndex) const;
  /// The closest point within `reach` on the triangles whose normal has a cosine of at least
  /// `min_cosine` with the unit vector `facing`. Here, a triangle's normal is the mean of the
  /// vertex normals at its corners, so that noise and sharp edges have less influence.
  SurfaceHit nearest_facing(const Eigen::Vector3d& point, const Eigen::Vector3d& facing,
                            double min_cosine, double reach, std::uint32_t guess = kNoIndex) const;

 private:
  /// Returns the closest point of one triangle, or no hit if the point is farther than `reach`.
  SurfaceHit hit_on_triangle(std::uint32_t triangle, const Eigen::Vector3d& point,
                             double reach) const;
  /// The closest point on the triangles for which `accept` returns true, if it is closer than
  /// `start`; otherwise `start`.
  template <class Accept>
  SurfaceHit search(const Eigen::Vector3d& point, const SurfaceHit& start,
                    const Accept& accept) const;

  const Positions& positions_;
  const std::vector<Triangle>& triangles_;
  /// for each triangle, the mean of its corners' normals
  std::vector<Eigen::Vector3d> mean_normals_;
  MedianSplitTree tree_;                    ///< contains the triangles with nonzero area
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< bounding box of each node of `tree_`
};

}  // namespace crowdface
