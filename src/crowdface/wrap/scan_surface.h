// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/mesh/alignment.h"
#include "crowdface/wrap/scan.h"
#include "crowdface/wrap/surface_tree.h"

namespace crowdface {

/// Two normals are compatible if the cosine between them is at least this value (60° or less).
inline constexpr double kMinNormalCosine = 0.5;

/// A scan prepared for closest-point queries.
class ScanSurface {
 public:
  /// Ignores small loose components.
  explicit ScanSurface(const Scan& scan);
  ScanSurface(const ScanSurface&) = delete;
  ScanSurface& operator=(const ScanSurface&) = delete;

  /// Result of `nearest`.
  struct ClosestPoint {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< the closest point on the scan
    /// unit normal, interpolated from the vertex normals
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    double distance = 0;    ///< distance from the query point
    bool is_found = false;  ///< whether a point is within reach and not on the scan's boundary
    bool is_on_boundary = false;        ///< whether the point lies on the scan's boundary
    std::uint32_t triangle = kNoIndex;  ///< index of the scan's triangle; kNoIndex: none in reach
  };
  /// The closest point within the distance `reach` whose normal has a cosine of at least
  /// `min_cosine` with the unit vector `facing`.
  /// \param guess  index of a triangle that is probably the closest, or kNoIndex.
  ClosestPoint nearest(const Eigen::Vector3d& point, const Eigen::Vector3d& facing,
                       double min_cosine, double reach, std::uint32_t guess = kNoIndex) const;
  /// The closest point within the distance `reach`, whatever its surface normal. If there is none,
  /// ClosestPoint::triangle is kNoIndex.
  /// \param guess  index of a triangle that is probably the closest, or kNoIndex.
  ClosestPoint nearest(const Eigen::Vector3d& point, double reach,
                       std::uint32_t guess = kNoIndex) const;

  /// The scan without small loose components.
  const Scan& scan() const { return scan_; }
  /// Unit normals of the scan's vertices; zero where undefined.
  const Positions& normals() const { return normals_; }
  /// For each vertex: whether the vertex lies on the scan's boundary.
  const std::vector<bool>& is_boundary_vertex() const { return is_boundary_vertex_; }

 private:
  /// Adds the surface normal to a hit, and whether the hit lies on the scan's boundary.
  ClosestPoint closest_point_of(const SurfaceHit& hit) const;

  Scan scan_;          ///< the scan without small loose components
  Positions normals_;  ///< unit normals of the vertices of `scan_`; zero where undefined
  /// for each vertex: whether the vertex lies on the scan's boundary
  std::vector<bool> is_boundary_vertex_;
  SurfaceTree tree_;  ///< contains the triangles of `scan_`
};

/// Returns the distance to the scan above which a point counts as an outlier: three standard
/// deviations of normally distributed noise (estimated from the median), but at least half of
/// `reach`.
/// \param distances  distances of points from the scan; not negative; may be empty
/// \param reach      largest distance of the search in which `distances` were found
double outlier_distance(std::vector<double> distances, double reach);

/// The inverse of the similarity y = s R x + t: x = Rᵀ (y − t) / s.
Similarity inverse(const Similarity& motion);

}  // namespace crowdface
