// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// Coefficients a_0 … a_K of the polynomial Σ_k a_k T_k(W), where W takes the mean over the
/// edge-neighbours.
using ChebyshevSeries = std::vector<double>;

/// Truncation tolerance: the sum of the discarded coefficients, as a fraction of the sum of all
/// coefficients.
inline constexpr double kSeriesTolerance = 1e-10;

/// The Chebyshev series of L = `level` smoothing iterations. The series represents x^L for the
/// umbrella operator and ((1 + x)/2)^L for the lazy operator. The umbrella series has about √(2 L
/// ln(2/tolerance)) terms, and the lazy series has 1/√2 as many terms. The coefficients are not
/// negative and sum to one, so constant fields and fixed boundaries stay unchanged. Level 0 gives
/// exactly {1}. Source: Sachdeva & Vishnoi 2014, "Faster algorithms via approximation theory", thm
/// 3.3. Each coefficient is computed from the previous coefficient and the ratio of the two, so
/// that no level overflows (docs/method.md).
ChebyshevSeries power_series(OperatorKind kind, std::uint64_t level,
                             double tolerance = kSeriesTolerance);

/// The Chebyshev series of S_L − 1, where S_L stands for L = `level` smoothing iterations. Applied
/// to positions, this series gives the displacements after L iterations.
ChebyshevSeries displacement_series(OperatorKind kind, std::uint64_t level,
                                    double tolerance = kSeriesTolerance);

/// The sum of the coefficients. At a vertex that smoothing leaves fixed, every Chebyshev term
/// equals the vertex's value, so the series multiplies the value by this sum. If the sum differs
/// from 0 or 1 only by rounding, the function returns exactly 0 or 1.
double coefficient_sum(const ChebyshevSeries& series);

}  // namespace crowdface
