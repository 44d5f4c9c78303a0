// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace crowdface {

/// Returns `side`² sample positions in [0, 1)². No two of them lie in one row or one column of a
/// grid of side² by side² cells (Kensler 2013, "Correlated multi-jittered sampling", canonical
/// arrangement).
std::vector<Eigen::Vector2f> sample_positions_in_pixel(int side);

/// Period of the interleaved ray directions: the pixels of a kInterleavePeriod by kInterleavePeriod
/// square use different directions, and the pattern repeats (Keller & Heidrich 2001, "Interleaved
/// sampling").
inline constexpr int kInterleavePeriod = 3;

/// Ray directions as points of the unit disc, uniform by area. Each pixel has `rays_per_pixel`
/// directions. Every block of 3 by 3 pixels has the same set of 9 · `rays_per_pixel` points.
class InterleavedDisc {
 public:
  /// Creates the pattern for this number of rays per pixel.
  explicit InterleavedDisc(int rays_per_pixel);
  /// The direction of ray `k` of pixel (x, y), as a point of the disc. Depends on x and y only
  /// modulo kInterleavePeriod.
  const Eigen::Vector2f& point(int x, int y, int k) const;
  std::size_t rays_per_pixel() const {
    return points_.size() / (kInterleavePeriod * kInterleavePeriod);
  }

 private:
  /// indexed as [ray][y][x], where x and y are modulo kInterleavePeriod
  std::vector<Eigen::Vector2f> points_;
};

}  // namespace crowdface
