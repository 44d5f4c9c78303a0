// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>

#include <Eigen/Core>

namespace crowdface {

/// Twice the signed area of the triangle with the corners 0, a and b.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Calls `body(x, y)` for each texel whose centre lies in the triangle or on its edge.
/// \param corners  in texels; y points downwards.
/// \param width, height  size of the texture image, in texels.
template <class Body>
void for_each_texel(const std::array<Eigen::Vector2d, 3>& corners, int width, int height,
                    const Body& body) {
  const double area = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const Eigen::Vector2d low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
  const Eigen::Vector2d high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
  const auto texel = [](double x, int count) {
    return static_cast<int>(std::clamp(x, 0.0, count - 1.0));
  };
  for (int y = texel(low.y(), height); y <= texel(high.y(), height); ++y) {
    for (int x = texel(low.x(), width); x <= texel(high.x(), width); ++x) {
      const Eigen::Vector2d from = Eigen::Vector2d(x + 0.5, y + 0.5) - corners[0];
      const double b = cross(from, corners[2] - corners[0]) / area,
                   c = cross(corners[1] - corners[0], from) / area;
      if (b >= 0 && c >= 0 && b + c <= 1) body(x, y);
    }
  }
}

}  // namespace crowdface
