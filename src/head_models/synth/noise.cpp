// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/noise.h"

#include <array>
#include <cmath>

namespace crowdface::synth {
namespace {

std::uint64_t scramble(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

/// Maps 64 random bits to [−1, 1).
double signed_unit(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1;
}

std::array<double, 4> spline(double t) {
  const double u = 1 - t;
  return {u * u * u / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * u * u * u - 6 * u * u + 4) / 6,
          t * t * t / 6};
}

}  // namespace

std::uint64_t mix(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  return scramble(scramble(scramble(a) ^ b) ^ c);
}

double SmoothNoise::at(const Eigen::Vector3d& point) const {
  std::array<std::int64_t, 3> cell{};
  std::array<std::array<double, 4>, 3> weights{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = point[static_cast<Eigen::Index>(k)] / spacing_, below = std::floor(x);
    cell[k] = static_cast<std::int64_t>(below);
    weights[k] = spline(x - below);
  }
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const auto x = static_cast<std::uint64_t>(cell[0] + static_cast<std::int64_t>(i));
      const auto y = static_cast<std::uint64_t>(cell[1] + static_cast<std::int64_t>(j));
      const std::uint64_t line = key_ ^ (x * 0x8CB92BA72F3D8DD7ULL + y * 0xD6E8FEB86659FD93ULL);
      double row = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto z = static_cast<std::uint64_t>(cell[2] + static_cast<std::int64_t>(k));
        row += weights[2][k] * signed_unit(scramble(line + z * 0xA0761D6478BD642FULL));
      }
      sum += weights[0][i] * weights[1][j] * row;
    }
  }
  return 2.5 * sum;  // the spline's averaging reduces the range to about two fifths
}

}  // namespace crowdface::synth
