// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/mesh/alignment.h"
#include "crowdface/wrap/scan.h"
#include "crowdface/wrap/surface_tree.h"

namespace crowdface {

inline constexpr double kLeastCosine = 0.5;  ///< of normals that face alike: within 60°

/// A scan made ready to be asked for the surface nearest to a place.
class ScanSurface {
 public:
  /// Loose crumbs are left out.
  explicit ScanSurface(const Scan& scan);
  ScanSurface(const ScanSurface&) = delete;
  ScanSurface& operator=(const ScanSurface&) = delete;

  struct Place {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< between those of the vertices, unit
    double distance = 0;
    bool found = false;  ///< something within reach, and not on a rim
    bool on_rim = false;
    std::uint32_t triangle = kNoIndex;
  };
  /// The nearest place whose surface faces within `least_cosine` of a unit vector.
  /// \param guess  the triangle of a place that may be it, or kNoIndex.
  Place nearest(const Eigen::Vector3d& point, const Eigen::Vector3d& facing, double least_cosine,
                double reach, std::uint32_t guess = kNoIndex) const;
  /// The nearest place whatever way it faces.
  Place nearest(const Eigen::Vector3d& point, double reach, std::uint32_t guess = kNoIndex) const;

  const Scan& scan() const { return scan_; }
  const Positions& normals() const { return normals_; }
  const std::vector<bool>& rim() const { return rim_; }

 private:
  Place place_of(const SurfaceHit& hit) const;

  Scan scan_;
  Positions normals_;
  std::vector<bool> rim_;
  SurfaceTree tree_;
};

/// From how far off what a scan tells counts little: three standard deviations of normal noise, by the median, and half
/// the reach at least. \param distances  none negative; may be empty
double outlier_distance(std::vector<double> distances, double reach);

/// y = s R x + t undone: x = Rᵀ (y − t) / s.
Similarity inverse(const Similarity& motion);

}  // namespace crowdface
