// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/sampling_pattern.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace crowdface {
namespace {

/// The binary digits of i mirrored at the binary point (van der Corput): 1/2, 1/4, 3/4, 1/8 … for i
/// = 1, 2, 3, 4 …
float radical_inverse(int i) {
  float value = 0;
  float digit = 0.5F;
  for (auto bits = static_cast<std::uint32_t>(i); bits != 0; bits >>= 1, digit /= 2) {
    if ((bits & 1U) != 0) value += digit;
  }
  return value;
}

/// Area-preserving map from the unit square to the unit disc (Shirley & Chiu 1997, "A low
/// distortion map between disk and square").
Eigen::Vector2f to_disc(float a, float b) {
  const float p = 2 * a - 1;
  const float q = 2 * b - 1;
  if (p == 0 && q == 0) return {0, 0};
  constexpr float kQuarter = std::numbers::pi_v<float> / 4;
  const bool wide = std::abs(p) > std::abs(q);
  const float radius = wide ? p : q;
  const float angle = wide ? kQuarter * q / p : 2 * kQuarter - kQuarter * p / q;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Point i of a Hammersley set of `count` points, mapped to the disc.
Eigen::Vector2f disc_point(int i, int count) {
  return to_disc(radical_inverse(i), (static_cast<float>(i) + 0.5F) / static_cast<float>(count));
}

}  // namespace

std::vector<Eigen::Vector2f> sample_positions_in_pixel(int side) {
  std::vector<Eigen::Vector2f> places;
  const auto cells = static_cast<float>(side);
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const auto i = static_cast<float>(column);
      const auto j = static_cast<float>(row);
      places.emplace_back((i + (j + 0.5F) / cells) / cells, (j + (i + 0.5F) / cells) / cells);
    }
  }
  return places;
}

InterleavedDisc::InterleavedDisc(int rays_per_pixel) {
  const int count = rays_per_pixel * kInterleavePeriod * kInterleavePeriod;
  for (int i = 0; i < count; ++i) points_.push_back(disc_point(i, count));
}

const Eigen::Vector2f& InterleavedDisc::point(int x, int y, int k) const {
  const int pixel = y % kInterleavePeriod * kInterleavePeriod + x % kInterleavePeriod;
  return points_[static_cast<std::size_t>(k * kInterleavePeriod * kInterleavePeriod + pixel)];
}

}  // namespace crowdface
