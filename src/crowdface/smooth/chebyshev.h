// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "crowdface/smooth/columns.h"
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

/// Computes T_0(W) x, T_1(W) x, … T_{terms − 1}(W) x and shows each block of rows as soon as it is
/// made: `visit(k, begin, end, block)`, `block` being the rows [begin, end) of T_k(W) x one after
/// the other. Calls for different blocks come from different threads; the ks of one block come in
/// order.
/// \param x  #V by C, C a multiple of 3, at most 12.
/// \throws InvalidInput if the row count is not the operator's or C is none of these.
void chebyshev_recurrence(
    const SmoothingOperator& smoothing, const Columns& x, Index terms,
    const std::function<void(Index k, Index begin, Index end, const double* block)>& visit);

/// Several polynomials of all columns in one pass: result[o] = Σ_k series[o][k] T_k(W) x. A row
/// that does not move is multiplied by the sum of the coefficients, and kept to the bit if that is
/// one.
std::vector<Columns> filter_many(const SmoothingOperator& smoothing, const Columns& x,
                                 const std::vector<ChebyshevSeries>& series);

/// One polynomial for each head that stands in the columns: columns 3g, 3g + 1, 3g + 2 are filtered
/// by series[g], in one pass over the mesh for up to four heads.
/// \param x  #V by 3·series.size()
Columns filter_each(const SmoothingOperator& smoothing, const Columns& x,
                    const std::vector<ChebyshevSeries>& series);

/// S_L x: positions after `level` iterations (Eq. 1), in O(√level) products. Differs from `iterate`
/// by less than 10⁻⁸ of the head's size.
Positions smooth(const SmoothingOperator& smoothing, const Positions& positions,
                 std::uint64_t level);

}  // namespace crowdface
