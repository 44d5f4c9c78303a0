// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace crowdface {

/// `side`² points of [0, 1)² of which no two share a row or a column of the fine grid (Kensler 2013,
/// "Correlated multi-jittered sampling", canonical arrangement).
std::vector<Eigen::Vector2f> places_in_pixel(int side);

/// Pixels of a square of this side look in directions that interleave; those of the next look in the same
/// (Keller & Heidrich 2001, "Interleaved sampling").
inline constexpr int kInterleave = 3;

/// Directions as points of the unit disc, even by area: `rays` for each pixel, and together with
/// those of the eight pixels around it, wherever it lies, always the same 9 · `rays`.
class InterleavedDisc {
 public:
  explicit InterleavedDisc(int rays);
  /// Ray `k` of a pixel; only x and y modulo kInterleave count.
  const Eigen::Vector2f& point(int x, int y, int k) const;
  std::size_t rays() const { return points_.size() / (kInterleave * kInterleave); }

 private:
  std::vector<Eigen::Vector2f> points_;
};

}  // namespace crowdface
