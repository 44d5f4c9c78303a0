// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/triangles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "crowdface/core/selection.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

using Vector = Eigen::Vector3d;

/// Computes the signed distances of the corners of `other` from the plane of `t`, all scaled by the
/// same factor.
///
/// \return  whether `other` has corners strictly on both sides of the plane.
bool crosses_plane(const Corners& t, const Vector& normal, const Corners& other,
                   std::array<double, 3>& distance) {
  for (std::size_t c = 0; c < 3; ++c) distance[c] = normal.dot(other[c] - t[0]);
  const auto [least, most] = std::ranges::minmax(distance);
  return least < 0 && most > 0;
}

/// Returns the interval in which triangle `t` meets the line of intersection of both triangles'
/// planes, as coordinates along `axis`.
///
/// \param distance  signed distances of the corners of `t` from the other triangle's plane. At
///                  least one is positive and one negative.
std::pair<double, double> interval_on_line(const Corners& t, const std::array<double, 3>& distance,
                                           Index axis) {
  std::size_t alone = 0;  // the corner that has no other corner on its side of the plane
  for (std::size_t c = 0; c < 3; ++c) {
    const double one = distance[c], two = distance[(c + 1) % 3], three = distance[(c + 2) % 3];
    if ((one > 0 && two <= 0 && three <= 0) || (one < 0 && two >= 0 && three >= 0)) alone = c;
  }
  const auto end_towards = [&](std::size_t other) {
    const double share = distance[alone] / (distance[alone] - distance[other]);
    return t[alone][axis] + share * (t[other][axis] - t[alone][axis]);
  };
  return std::minmax({end_towards((alone + 1) % 3), end_towards((alone + 2) % 3)});
}

}  // namespace

TargetTriangles::TargetTriangles(const std::vector<Triangle>& triangles, const Positions& target) {
  // a triangle is degenerate if the sine of a corner's angle is below this value
  constexpr double kMinSine = 1e-4;
  planar_triangles_.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    const Vector u = row3(target, t[1]) - row3(target, t[0]);
    const Vector v = row3(target, t[2]) - row3(target, t[0]);
    const Vector normal = u.cross(v);
    if (!(normal.squaredNorm() > kMinSine * kMinSine * u.squaredNorm() * v.squaredNorm())) continue;
    const double length = std::sqrt(u.squaredNorm());
    const double apex_x = u.dot(v) / length;
    planar_triangles_.push_back(
        {t, normal, 1 / length, apex_x, length / std::sqrt(normal.squaredNorm())});
  }
}

LocalDefects TargetTriangles::compare(const Positions& positions) const {
  constexpr double kCollapsed = 0.02, kPercentile = 0.99;
  LocalDefects defects;
  std::vector<double> stretches;
  stretches.reserve(planar_triangles_.size());
  for (const PlanarTriangle& frame : planar_triangles_) {
    const Vector origin = row3(positions, frame.corners[0]);
    const Vector u = row3(positions, frame.corners[1]) - origin;
    const Vector v = row3(positions, frame.corners[2]) - origin;
    const Vector normal = u.cross(v);
    const bool turned = normal.dot(frame.normal) < 0;
    const bool collapsed =
        normal.squaredNorm() < kCollapsed * kCollapsed * frame.normal.squaredNorm();
    if (turned || collapsed) ++defects.flipped_triangle_count;
    // Compute the square of the largest singular value of the linear map from the target triangle
    // to this triangle. x and y are the images of the axes of `frame`.
    const Vector x = frame.inverse_length * u;
    const Vector y = frame.inverse_apex_y * (v - frame.apex_x * x);
    const double a = x.squaredNorm(), b = x.dot(y), c = y.squaredNorm();
    stretches.push_back(0.5 * (a + c) + std::sqrt(0.25 * (a - c) * (a - c) + b * b));
  }
  defects.compared_triangle_count = static_cast<Index>(stretches.size());
  if (!stretches.empty()) {
    const double count = static_cast<double>(stretches.size());
    const auto rank = static_cast<std::size_t>(kPercentile * count);
    defects.stretch_factor = std::sqrt(nth_smallest(std::move(stretches), rank));
  }
  return defects;
}

Corners corners_of(const Positions& positions, const Triangle& triangle) {
  return {row3(positions, triangle[0]), row3(positions, triangle[1]), row3(positions, triangle[2])};
}

bool triangles_intersect(const Positions& positions, const Triangle& a, const Triangle& b) {
  const Corners p = corners_of(positions, a), q = corners_of(positions, b);
  std::array<double, 3> p_side, q_side;
  const Vector n = (p[1] - p[0]).cross(p[2] - p[0]);
  if (!crosses_plane(p, n, q, q_side)) return false;
  const Vector m = (q[1] - q[0]).cross(q[2] - q[0]);
  if (!crosses_plane(q, m, p, p_side)) return false;
  Index axis = 0;
  n.cross(m).cwiseAbs().maxCoeff(&axis);
  const auto [p_low, p_high] = interval_on_line(p, p_side, axis);
  const auto [q_low, q_high] = interval_on_line(q, q_side, axis);
  return p_low < q_high && q_low < p_high;
}

}  // namespace crowdface
