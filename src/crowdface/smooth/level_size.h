// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// The wavelength whose amplitude a Gaussian filter of standard deviation 1 halves: π·√(2/ln 2).
inline constexpr double kWavelengthPerSigma = 5.336446256636997;

/// The largest number of iterations that iterations_for_wavelength returns.
inline constexpr std::uint64_t kMaxLevel = 1'000'000'000;

/// The number of smoothing iterations whose half-amplitude wavelength is nearest to `wavelength`,
/// for a mesh with the given edge length. L iterations act like a Gaussian filter. With h =
/// edge_length, its standard deviation is σ = h·√(L/2) for the umbrella operator and σ = (h/2)·√L
/// for the lazy operator. The Gaussian halves the amplitude of waves of length
/// kWavelengthPerSigma·σ.
/// \param wavelength   half-amplitude wavelength, the wavelength whose amplitude the filter halves.
/// \param edge_length  in the unit of `wavelength`.
/// \throws InvalidInput if an argument is not positive or the result exceeds kMaxLevel.
std::uint64_t iterations_for_wavelength(OperatorKind kind, double wavelength, double edge_length);

/// The inverse of iterations_for_wavelength. Returns the half-amplitude wavelength of `level`
/// iterations, in the unit of the edge length.
double wavelength_of_iterations(OperatorKind kind, std::uint64_t level, double edge_length);

/// The distinct levels round(max_level·(j/steps)²) for j = 0 … steps. The levels are dense near 0,
/// where smoothing removes fine detail.
std::vector<std::uint64_t> levels_dense_at_start(std::uint64_t max_level, int steps);

}  // namespace crowdface
