// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "crowdface/blend/recipe.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/region/region_weights.h"
#include "crowdface/smooth/chebyshev_filter.h"

namespace crowdface {

/// Returns B, #V by 3: the positions of the target or, if the target is a mixture, the weighted
/// mean of the heads in the mixture.
Positions target_positions(const HeadSet& heads, const Recipe& recipe);

/// Blends the face of a recipe, without mirroring. Unlike CrowdBlender, smooths exactly: applies
/// the filter once for each band of each region. Computes Eq. 7 in the second form below:
///
///     A = Σ_k α_k [ e_k C̄_k + S_{L_k} D_k ]
///       = B + Σ_k α_k [ S_{L_k} D_k − D_k ]
///
/// B is the target. Region k has the vertex weights α_k, the smoothing S_{L_k} to level L_k, the
/// extrapolation factor e_k, the weighted mean of the source heads C̄_k = Σ_i ω̂_ki C_i, and the
/// difference D_k = B − e_k C̄_k. weights_by_level generalises Eq. 7 to several bands.
///
/// The second form keeps a vertex bit-identical to B if the vertex is fixed or if D_k = 0 there
/// (when the target is blended with itself). For a mixture, B is the weighted mean of its heads.
///
/// \param regions  α of the recipe's regions, #V by #regions; rows sum to one.
/// \return         #V by 3, in the unit of the heads.
/// \throws BrokenPrecondition if recipe, regions and heads do not fit together.
Positions blend_exact(const HeadSet& heads, const ChebyshevFilter& filter,
                      const RegionWeights& regions, const Recipe& recipe);

/// Blends several faces in one pass of the filter. The results have the same bits as if each face
/// were blended alone.
///
/// \param results  receives the positions of the face of each recipe.
void blend_exact(const HeadSet& heads, const ChebyshevFilter& filter, const RegionWeights& regions,
                 std::span<const Recipe* const> recipes, std::span<Positions> results);

}  // namespace crowdface
