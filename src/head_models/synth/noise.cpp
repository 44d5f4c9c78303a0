// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/noise.h"

#include <array>
#include <cmath>
#include <vector>

#include "crowdface/core/smooth_step.h"

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

/// The coefficients of the 4 × 4 × 4 lattice points around a cell, indexed as [z][4 x + y].
using Coefficients = std::array<std::array<double, 16>, 4>;

/// Returns the coefficients around a cell. Each thread caches recently used cells (direct-mapped),
/// because neighbouring texels are mostly in the same cells.
const Coefficients& coefficients_of(std::uint64_t key, const std::array<std::int64_t, 3>& cell) {
  struct Entry {
    std::uint64_t key;
    std::array<std::int64_t, 3> cell;
    Coefficients coefficients;
    bool filled;
  };
  constexpr std::size_t kEntries = 1024;
  thread_local std::vector<Entry> entries(kEntries);
  std::uint64_t place = key;
  for (const std::int64_t c : cell)
    place = (place ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ULL;
  Entry& entry = entries[(place >> 32) % kEntries];
  if (entry.filled && entry.key == key && entry.cell == cell) return entry.coefficients;
  entry.key = key;
  entry.cell = cell;
  entry.filled = true;
  for (std::size_t line = 0; line < 16; ++line) {
    const auto x = static_cast<std::uint64_t>(cell[0]) + line / 4;
    const auto y = static_cast<std::uint64_t>(cell[1]) + line % 4;
    const std::uint64_t start = key ^ (x * 0x8CB92BA72F3D8DD7ULL + y * 0xD6E8FEB86659FD93ULL);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto z = static_cast<std::uint64_t>(cell[2]) + k;
      entry.coefficients[k][line] = signed_unit(scramble(start + z * 0xA0761D6478BD642FULL));
    }
  }
  return entry.coefficients;
}

}  // namespace

double smooth_wave(double x) {
  return 1 - 2 * smooth_step(0, 1, std::abs(x - 2 * std::round(x / 2)));
}

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
  const Coefficients& coefficients = coefficients_of(key_, cell);
  std::array<double, 16> rows{};
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t line = 0; line < 16; ++line) {
      rows[line] += weights[2][k] * coefficients[k][line];
    }
  }
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) sum += weights[0][i] * weights[1][j] * rows[4 * i + j];
  }
  return 2.5 * sum;  // the spline's averaging reduces the range to about two fifths
}

}  // namespace crowdface::synth
