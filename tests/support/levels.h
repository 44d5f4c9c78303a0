// SPDX-License-Identifier: Apache-2.0
// Single levels from what the library fits.
#pragma once

#include "crowdface/smooth/cubic_fit.h"
#include "crowdface/smooth/level_basis.h"

namespace crowdface::testing {

/// x + Σ_p functions[p]·fields_p
template <class Functions>
Positions sum_of_fields(const Positions& x, const Functions& functions, const LevelFields& fields) {
  Positions result = x;
  for (Index p = 0; p < fields.rank; ++p) {
    for (Index i = 0; i < result.size(); ++i) {
      result.data()[i] += functions[static_cast<std::size_t>(p)] * fields.value(p, i / 3, i % 3);
    }
  }
  return result;
}

/// S̃_L x of the head the fit was made from.
inline Positions evaluate(const CubicFit& fit, const Positions& positions, std::uint64_t level) {
  return sum_of_fields(positions, cubic_basis(level, fit.max_level), fit.fields);
}

inline Positions evaluate(const LevelBasis& basis, const LevelNodes& nodes,
                          const Positions& positions, std::uint64_t level) {
  return sum_of_fields(positions, level_function_values(nodes, basis.function_coefficients, level),
                       basis.fields);
}

}  // namespace crowdface::testing
