// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/ball_radii.h"

#include <algorithm>

#include "crowdface/parts/point_grid.h"

namespace crowdface {
namespace {

/// Returns the distance at which a ray from the centre intersects the surface, by Newton steps on
/// the tangent planes at the nearest points. Where the surface has a hole, the tangent plane beside
/// the hole replaces the missing surface.
double radius_along(const Topology& topology, const VertexFaces& faces, const Positions& head,
                    const Eigen::Vector3d& centre, const Eigen::Vector3d& direction, double radius,
                    std::uint32_t& nearest) {
  constexpr int kSteps = 3;
  constexpr double kMinSlope = 0.3, kMaxChange = 0.5;
  double along = radius;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::Vector3d point = centre + along * direction;
    const SurfacePoint place = nearest_point_from(topology, faces, head, nearest, point);
    nearest = place.corners[0];
    Eigen::Vector3d outward = normal_at(head, place);
    if (outward.dot(place.position - centre) < 0) outward = -outward;
    const double slope = std::max(outward.dot(direction), kMinSlope);
    along -= outward.dot(point - place.position) / slope;
  }
  return std::clamp(along, (1 - kMaxChange) * radius, (1 + kMaxChange) * radius);
}

}  // namespace

BallRadii::BallRadii(const Topology& topology, const VertexFaces& faces, const Positions& head,
                     std::span<const std::uint32_t> vertices, const Eigen::Vector3d& centre,
                     double radius, const HeadAxes& axes)
    : axes_(axes),
      side_(axes.side()),
      centre_(centre),
      radius_(radius),
      radii_(kNodesPerSide * kNodesPerSide, static_cast<float>(radius)) {
  const PointGrid grid(head, vertices);
  for (std::size_t y = 0; y < kNodesPerSide; ++y) {
    std::uint32_t nearest = kNoIndex;
    for (std::size_t x = 0; x < kNodesPerSide; ++x) {
      constexpr double kStep = 2 * kHalfWidth / (kNodesPerSide - 1);
      const double p = static_cast<double>(x) * kStep - kHalfWidth;
      const double q = static_cast<double>(y) * kStep - kHalfWidth;
      const double square = p * p + q * q;
      if (square > kHalfWidth * kHalfWidth * 1.1) continue;
      // Inverse stereographic projection.
      const Eigen::Vector3d direction =
          (2 * p * side_ + 2 * q * axes_.up + (1 - square) * axes_.front) / (1 + square);
      if (nearest == kNoIndex) nearest = grid.nearest(centre + radius * direction).vertex;
      radii_[y * kNodesPerSide + x] = static_cast<float>(
          radius_along(topology, faces, head, centre, direction, radius, nearest));
    }
  }
  max_radius_ = static_cast<double>(*std::ranges::max_element(radii_));
}

BallRadii::Gap BallRadii::gap_at(const Eigen::Vector3d& centre_to_point) const {
  const double distance = centre_to_point.norm();
  if (!(distance > 0)) return {-radius_, axes_.front};
  const Eigen::Vector3d direction = centre_to_point / distance;
  const double down = 1 / std::max(1 + direction.dot(axes_.front), 0.1);
  const double p = direction.dot(side_) * down, q = direction.dot(axes_.up) * down;
  constexpr double kPerWidth = (kNodesPerSide - 1) / (2 * kHalfWidth),
                   kLast = kNodesPerSide - 1.001;
  const double x = std::clamp((p + kHalfWidth) * kPerWidth, 0.0, kLast);
  const double y = std::clamp((q + kHalfWidth) * kPerWidth, 0.0, kLast);
  const auto i = static_cast<std::size_t>(x), j = static_cast<std::size_t>(y);
  const double u = x - static_cast<double>(i), v = y - static_cast<double>(j);
  const double a = radius_at_node(i, j), b = radius_at_node(i + 1, j), c = radius_at_node(i, j + 1),
               d = radius_at_node(i + 1, j + 1);
  const double radius = (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d);
  const double by_p = ((1 - v) * (b - a) + v * (d - c)) * kPerWidth;
  const double by_q = ((1 - u) * (c - a) + u * (d - b)) * kPerWidth;
  // To first order, the gap is F / |∇F| for F(x) = |x| − radius(x / |x|). Here x is the vector from
  // the eyeball's centre to the point.
  const Eigen::Vector3d slope =
      down * (by_p * (side_ - p * axes_.front) + by_q * (axes_.up - q * axes_.front));
  const Eigen::Vector3d gradient =
      direction - (slope - slope.dot(direction) * direction) / distance;
  const double length = gradient.norm();
  return {(distance - radius) / length, gradient / length};
}

}  // namespace crowdface
