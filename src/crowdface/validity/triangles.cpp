// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/triangles.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/selection.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

using Vector = Eigen::Vector3d;

/// Where triangle `t`, whose corners have these distances from the other's plane, meets the line
/// that both planes share, along `axis`. False if it does not cross the plane.
bool interval_on_line(const std::array<Vector, 3>& t, const std::array<double, 3>& distance,
                      int axis, double& low, double& high) {
  // The corner that is alone on its side.
  int alone = -1;
  for (int c = 0; c < 3; ++c) {
    const double one = distance[static_cast<std::size_t>(c)];
    const double two = distance[static_cast<std::size_t>((c + 1) % 3)];
    const double three = distance[static_cast<std::size_t>((c + 2) % 3)];
    if ((one > 0 && two <= 0 && three <= 0) || (one < 0 && two >= 0 && three >= 0)) alone = c;
  }
  if (alone < 0) return false;
  double ends[2];
  for (int e = 0; e < 2; ++e) {
    const auto a = static_cast<std::size_t>(alone);
    const auto b = static_cast<std::size_t>((alone + 1 + e) % 3);
    const double share = distance[a] / (distance[a] - distance[b]);
    ends[e] = t[a][axis] + share * (t[b][axis] - t[a][axis]);
  }
  low = std::min(ends[0], ends[1]);
  high = std::max(ends[0], ends[1]);
  return true;
}

}  // namespace

TargetTriangles::TargetTriangles(const std::vector<Triangle>& triangles, const Positions& target) {
  constexpr double kSliver = 1e-4;
  for (const Triangle& t : triangles) {
    const Vector u = row3(target, t[1]) - row3(target, t[0]);
    const Vector v = row3(target, t[2]) - row3(target, t[0]);
    const Vector normal = cross3(u, v);
    if (!(dot3(normal, normal) > kSliver * kSliver * dot3(u, u) * dot3(v, v))) continue;
    const double length = std::sqrt(dot3(u, u));
    const double shift = dot3(u, v) / length;
    frames_.push_back({t, normal, length, shift, std::sqrt(dot3(normal, normal)) / length});
  }
}

LocalDefects TargetTriangles::compare(const Positions& positions) const {
  constexpr double kCollapsed = 0.02, kPercentile = 0.99;
  LocalDefects defects;
  std::vector<double> stretches;
  stretches.reserve(frames_.size());
  for (const Frame& frame : frames_) {
    const Vector origin = row3(positions, frame.corners[0]);
    const Vector u = row3(positions, frame.corners[1]) - origin;
    const Vector v = row3(positions, frame.corners[2]) - origin;
    const Vector normal = cross3(u, v);
    const bool turned = dot3(normal, frame.normal) < 0;
    const bool collapsed =
        dot3(normal, normal) < kCollapsed * kCollapsed * dot3(frame.normal, frame.normal);
    if (turned || collapsed) ++defects.flipped;
    // The largest singular value, squared, of the map from the frame: images of its two axes.
    const Vector x = u / frame.length;
    const Vector y = (v - frame.shift * x) / frame.height;
    const double a = dot3(x, x), b = dot3(x, y), c = dot3(y, y);
    stretches.push_back(0.5 * (a + c) + std::sqrt(0.25 * (a - c) * (a - c) + b * b));
  }
  defects.compared = static_cast<Index>(stretches.size());
  if (!stretches.empty()) {
    const double count = static_cast<double>(stretches.size());
    const auto rank = static_cast<std::size_t>(kPercentile * count);
    defects.stretch = std::sqrt(value_of_rank(std::move(stretches), rank));
  }
  return defects;
}

bool triangles_intersect(const Positions& positions, const Triangle& a, const Triangle& b) {
  std::array<Vector, 3> p, q;
  for (std::size_t c = 0; c < 3; ++c) {
    p[c] = row3(positions, a[c]);
    q[c] = row3(positions, b[c]);
  }
  const Vector n = cross3(p[1] - p[0], p[2] - p[0]);
  std::array<double, 3> q_side;
  for (std::size_t c = 0; c < 3; ++c) q_side[c] = dot3(n, q[c] - p[0]);
  if (std::min({q_side[0], q_side[1], q_side[2]}) >= 0) return false;
  if (std::max({q_side[0], q_side[1], q_side[2]}) <= 0) return false;
  const Vector m = cross3(q[1] - q[0], q[2] - q[0]);
  std::array<double, 3> p_side;
  for (std::size_t c = 0; c < 3; ++c) p_side[c] = dot3(m, p[c] - q[0]);
  if (std::min({p_side[0], p_side[1], p_side[2]}) >= 0) return false;
  if (std::max({p_side[0], p_side[1], p_side[2]}) <= 0) return false;
  const Vector line = cross3(n, m);
  int axis = 0;
  for (int c = 1; c < 3; ++c) {
    if (std::abs(line[c]) > std::abs(line[axis])) axis = c;
  }
  double p_low = 0, p_high = 0, q_low = 0, q_high = 0;
  return interval_on_line(p, p_side, axis, p_low, p_high) &&
         interval_on_line(q, q_side, axis, q_low, q_high) && p_low < q_high && q_low < p_high;
}

bool share_vertex(const Triangle& a, const Triangle& b) {
  return std::ranges::any_of(
      a, [&](std::uint32_t vertex) { return std::ranges::find(b, vertex) != b.end(); });
}

}  // namespace crowdface
