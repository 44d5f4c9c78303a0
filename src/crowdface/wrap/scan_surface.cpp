// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/scan_surface.h"

#include <algorithm>
#include <utility>

#include "crowdface/core/selection.h"

namespace crowdface {
namespace {

/// The surface ignores components, such as dust and hair clips, with less than this fraction of the
/// largest component's area. Eyeballs are kept: an eyeball has about 0.01 of a head's area.
constexpr double kMinAreaFraction = 0.001;

constexpr double kZeroTolerance = 1e-9;  ///< smaller barycentric coordinates count as zero

}  // namespace

ScanSurface::ScanSurface(const Scan& scan)
    : scan_(remove_small_pieces(scan, kMinAreaFraction)),
      normals_(vertex_normals_or_zero(scan_.triangles, scan_.positions)),
      is_boundary_vertex_(
          build_adjacency(topology_of(scan_.triangles, scan_.positions.rows())).boundary),
      tree_(scan_.positions, scan_.triangles) {}

ScanSurface::ClosestPoint ScanSurface::closest_point_of(const SurfaceHit& hit) const {
  ClosestPoint place;
  if (hit.triangle == kNoIndex) return place;
  const Triangle& corners = scan_.triangles[hit.triangle];
  place.triangle = hit.triangle;
  place.point = hit.point;
  place.distance = hit.distance;
  bool rim = true;  // all corners with a nonzero coordinate are on the boundary
  for (std::size_t k = 0; k < 3; ++k) {
    place.normal += hit.barycentric[k] * normals_.row(corners[k]).transpose();
    if (hit.barycentric[k] > kZeroTolerance && !is_boundary_vertex_[corners[k]]) rim = false;
  }
  place.normal = place.normal.normalized();
  place.is_on_boundary = rim;
  place.is_found = !rim && !place.normal.isZero();
  return place;
}

ScanSurface::ClosestPoint ScanSurface::nearest(const Eigen::Vector3d& point,
                                               const Eigen::Vector3d& facing, double min_cosine,
                                               double reach, std::uint32_t guess) const {
  return closest_point_of(tree_.nearest_facing(point, facing, min_cosine, reach, guess));
}

ScanSurface::ClosestPoint ScanSurface::nearest(const Eigen::Vector3d& point, double reach,
                                               std::uint32_t guess) const {
  return closest_point_of(tree_.nearest(point, reach, guess));
}

Similarity inverse(const Similarity& motion) {
  Similarity undone;
  undone.rotation = motion.rotation.transpose();
  undone.scale = 1 / motion.scale;
  undone.translation = -(undone.scale * (undone.rotation * motion.translation));
  return undone;
}

double outlier_distance(std::vector<double> distances, double reach) {
  const double least = 0.5 * reach;
  if (distances.empty()) return least;
  const std::size_t middle = distances.size() / 2;
  return std::max(least, 4.5 * nth_smallest(std::move(distances), middle));
}

}  // namespace crowdface
