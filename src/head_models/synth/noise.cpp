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

Eigen::Array4d spline(double t) {
  const double u = 1 - t, tt = t * t, uu = u * u;
  return {uu * u / 6, (3 * tt * t - 6 * tt + 4) / 6, (3 * uu * u - 6 * uu + 4) / 6, tt * t / 6};
}

/// The coefficients of the 4 × 4 × 4 lattice points around a cell: row 4 x + y, column z.
using Coefficients = Eigen::Array<double, 16, 4>;

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
  // Compare three numbers, which is faster than operator== of std::array: this operator calls
  // memcmp.
  const bool same_cell =
      entry.cell[0] == cell[0] && entry.cell[1] == cell[1] && entry.cell[2] == cell[2];
  if (entry.filled && entry.key == key && same_cell) return entry.coefficients;
  entry.key = key;
  entry.cell = cell;
  entry.filled = true;
  for (std::size_t line = 0; line < 16; ++line) {
    const auto x = static_cast<std::uint64_t>(cell[0]) + line / 4;
    const auto y = static_cast<std::uint64_t>(cell[1]) + line % 4;
    const std::uint64_t start = key ^ (x * 0x8CB92BA72F3D8DD7ULL + y * 0xD6E8FEB86659FD93ULL);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto z = static_cast<std::uint64_t>(cell[2]) + k;
      entry.coefficients(static_cast<Eigen::Index>(line), static_cast<Eigen::Index>(k)) =
          signed_unit(scramble(start + z * 0xA0761D6478BD642FULL));
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
  std::array<Eigen::Array4d, 3> weights;
  for (std::size_t k = 0; k < 3; ++k) {
    // Round down without std::floor, which is a function call without SSE4.1
    const double x = point[static_cast<Eigen::Index>(k)] / spacing_;
    cell[k] = static_cast<std::int64_t>(x);
    if (static_cast<double>(cell[k]) > x) --cell[k];
    weights[k] = spline(x - static_cast<double>(cell[k]));
  }
  const Coefficients& lattice = coefficients_of(key_, cell);
  // Interpolate between 4 × 4 × 4 lattice values: compute the sum of all values, each multiplied by
  // its three weights (along x, y and z). Sum over z first, then over x, then over y. Each of these
  // steps adds short vectors, which the compiler turns into SIMD instructions.
  const auto& [along_x, along_y, along_z] = weights;
  const Eigen::Array<double, 16, 1> lines =
      along_z[0] * lattice.col(0) + along_z[1] * lattice.col(1) + along_z[2] * lattice.col(2) +
      along_z[3] * lattice.col(3);
  const Eigen::Array4d row = along_x[0] * lines.segment<4>(0) + along_x[1] * lines.segment<4>(4) +
                             along_x[2] * lines.segment<4>(8) + along_x[3] * lines.segment<4>(12);
  const double sum =
      (along_y[0] * row[0] + along_y[1] * row[1]) + (along_y[2] * row[2] + along_y[3] * row[3]);
  return 2.5 * sum;  // the spline's averaging reduces the range to about two fifths
}

}  // namespace crowdface::synth
