// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// Half-amplitude wavelength of a Gaussian of standard deviation 1: π·√(2/ln 2).
inline constexpr double kWavelengthPerSigma = 5.336446256636997;

/// More iterations than this no size stands for.
inline constexpr std::uint64_t kMaxLevel = 1'000'000'000;

/// The whole number of iterations whose size is nearest to `size` on edges of this length: L
/// iterations act like a Gaussian of σ = h·√(L/2) (lazy: h·√L/2), which halves waves of length
/// 5.34·σ.
/// \param size, edge_length  in the same unit, both positive.
/// \throws InvalidInput if an argument is not positive or the result would exceed kMaxLevel.
std::uint64_t iterations_of_size(OperatorKind kind, double size, double edge_length);

/// The inverse: the half-amplitude wavelength of `level` iterations, in the unit of the edge
/// length.
double size_of_iterations(OperatorKind kind, std::uint64_t level, double edge_length);

/// The levels round(max_level·(j/steps)²) for j = 0 … steps, each once: dense at the start, where fine
/// detail goes.
std::vector<std::uint64_t> levels_dense_at_start(std::uint64_t max_level, int steps);

}  // namespace crowdface
