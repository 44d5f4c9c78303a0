// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/sampling_pattern.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace crowdface {
namespace {

/// The bits of i behind the point in reverse: 1/2, 1/4, 3/4, 1/8 … (van der Corput).
float radical_inverse(int i) {
  float value = 0;
  float digit = 0.5F;
  for (auto bits = static_cast<std::uint32_t>(i); bits != 0; bits >>= 1, digit /= 2) {
    if ((bits & 1U) != 0) value += digit;
  }
  return value;
}

/// From the unit square to the unit disc, areas kept (Shirley & Chiu 1997, "A low distortion map
/// between disk and square").
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

/// Point i of `count`, all of them together even over the disc (Hammersley's points).
Eigen::Vector2f disc_point(int i, int count) {
  return to_disc(radical_inverse(i), (static_cast<float>(i) + 0.5F) / static_cast<float>(count));
}

float fraction(float x) {
  return x - std::floor(x);
}

}  // namespace

SamplingPattern::SamplingPattern(int samples_per_side, int sky_rays) {
  const int samples = samples_per_side * samples_per_side;
  const auto side = static_cast<float>(samples_per_side);
  for (int s = 0; s < samples; ++s) {
    // No two samples share a row or a column of the fine grid (Kensler 2013, "Correlated
    // multi-jittered sampling", canonical arrangement).
    const int column = s % samples_per_side;
    const int row = s / samples_per_side;
    const auto i = static_cast<float>(column);
    const auto j = static_cast<float>(row);
    places.emplace_back((i + (j + 0.5F) / side) / side, (j + (i + 0.5F) / side) / side);
    lamp.push_back(disc_point(s, samples));
    // Strided, so that the rays of one sample alone are spread out too.
    for (int r = 0; r < sky_rays; ++r) {
      sky.push_back(disc_point(r * samples + s, samples * sky_rays));
    }
  }
}

Eigen::Vector2f pixel_turn(int x, int y) {
  const float phase = fraction(52.9829189F * fraction(0.06711056F * static_cast<float>(x) +
                                                      0.00583715F * static_cast<float>(y)));
  const float angle = 2 * std::numbers::pi_v<float> * phase;
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace crowdface
