// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "crowdface/smooth/chebyshev_filter.h"
#include "crowdface/smooth/level_fields.h"

namespace crowdface {

/// The approximation of smoothed heads in the paper on which crowdface is based (§5.1, see
/// docs/method.md). S_L x are the positions x of a head after L smoothing iterations (level L).
/// With t = L/L_max, each coordinate of the displacement is a cubic in t:
///
///     S_L x − x ≈ c_0 + c_1 t + c_2 t² + c_3 t³
///
/// The cubic is fitted by least squares to about 40 levels. The error is millimetres where the head
/// moves by centimetres, so this fit only serves comparisons.
struct CubicFit {
  static constexpr int kRank = 4;  ///< number of vector fields, the coefficients of the cubic
  std::uint64_t max_level = 1;     ///< L_max, the highest fitted level
  LevelFields fields;              ///< the fields c_0 … c_3
};

/// The cubic is fitted to the smoothing levels that levels_dense_at_start returns for this number
/// of steps. The paper (docs/paper.md) uses the same number.
inline constexpr int kCubicFitSteps = 40;

/// Fits the cubic functions to one head. The recurrence accumulates the fields c_0 … c_3 directly,
/// without storing levels.
CubicFit fit_cubic(const ChebyshevFilter& filter, const Positions& positions,
                   std::uint64_t max_level);

/// The basis functions φ_0 … φ_3 at a level: 1, t, t², t³ with t = level/max_level.
std::array<double, CubicFit::kRank> cubic_basis(std::uint64_t level, std::uint64_t max_level);

}  // namespace crowdface
