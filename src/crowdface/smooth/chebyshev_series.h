// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// Coefficients a_0 … a_K of a polynomial in the one-ring mean W: Σ_k a_k T_k(W).
using ChebyshevSeries = std::vector<double>;

/// What a series may leave out: the dropped tail's share of its sum.
inline constexpr double kSeriesTolerance = 1e-10;

/// The series of `level` iterations: of x^L for the umbrella operator, of ((1 + x)/2)^L for the
/// lazy one. About √(2 L ln(2/tolerance)) terms (lazy: 1/√2 of that); the coefficients are not
/// negative and sum to one, so that constants and rims stay. Level 0 is exactly {1}. Source:
/// Sachdeva & Vishnoi 2014, "Faster algorithms via approximation theory", thm 3.3; the terms by
/// their ratio, so that no level overflows (docs/method.md).
ChebyshevSeries power_series(OperatorKind kind, std::uint64_t level,
                             double tolerance = kSeriesTolerance);

/// The series of S_L − 1, the displacement by `level` iterations.
ChebyshevSeries displacement_series(OperatorKind kind, std::uint64_t level,
                                    double tolerance = kSeriesTolerance);

/// What a series does to a value that no iteration moves: the sum of its coefficients, exactly one
/// or zero where it is that but for rounding.
double sum_of(const ChebyshevSeries& series);

}  // namespace crowdface
