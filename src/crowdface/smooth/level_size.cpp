// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/level_size.h"

#include <cmath>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// The variance σ² that one iteration adds to the equivalent Gaussian, in squared edge lengths.
double variance_per_iteration(OperatorKind kind) {
  return kind == OperatorKind::kLazy ? 0.25 : 0.5;
}

}  // namespace

std::uint64_t iterations_for_wavelength(OperatorKind kind, double wavelength, double edge_length) {
  if (!(wavelength > 0) || !(edge_length > 0)) {
    throw InvalidInput(concat("a level's size and the edge length must be positive, got ",
                              wavelength, " and ", edge_length));
  }
  const double sigma = wavelength / kWavelengthPerSigma / edge_length;
  const double level = std::round(sigma * sigma / variance_per_iteration(kind));
  if (level > static_cast<double>(kMaxLevel)) {
    throw InvalidInput(concat("a size of ", wavelength, " on edges of ", edge_length,
                              " would take more than 10^9 iterations"));
  }
  return static_cast<std::uint64_t>(level);
}

double wavelength_of_iterations(OperatorKind kind, std::uint64_t level, double edge_length) {
  const double variance = variance_per_iteration(kind) * static_cast<double>(level);
  return kWavelengthPerSigma * edge_length * std::sqrt(variance);
}

std::vector<std::uint64_t> levels_dense_at_start(std::uint64_t max_level, int steps) {
  std::vector<std::uint64_t> levels;
  for (int j = 0; j <= steps; ++j) {
    const double share = static_cast<double>(j) / steps;
    const auto level =
        static_cast<std::uint64_t>(std::round(static_cast<double>(max_level) * share * share));
    if (levels.empty() || level != levels.back()) levels.push_back(level);
  }
  return levels;
}

}  // namespace crowdface
